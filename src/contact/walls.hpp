#pragma once
// Rigid half-planes that bodies rest on or are pressed by.
//
// A contactor point at x that is d = (p - x) . n > 0 inside a wall with the face point p(t) and the outward normal n is
// pushed out by k d n, k = p_n h l; along the tangent t a spring holds it to the wall, at most mu times the normal
// force. Both are those of contact_point.hpp with the wall as the target, n and t fixed. The penalty is twice the
// stiffness of the body's layer of elements: a body then presses against a wall as it would against its mirror image.
//
// Under stress in situ a wall presses from the start: a point on its face counts as if it were as deep in it as that
// takes, from then on.
//
// A wall that moves does work: its force times its way, by the trapezoidal rule along a step, which closes the balance
// of the leapfrog exactly while a point stays in touch.

#include <memory>
#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "model/options.hpp"

namespace gneiss {

class Walls final : public Interaction {
public:
    struct Wall {
        Vec2<double> point;     ///< at t = 0, m
        Vec2<double> normal;    ///< of length 1
        Vec2<double> velocity;  ///< m/s
        double friction;        ///< mu, >= 0
    };

    /// @param contact  whose bodies they are; it stands before the walls among the interactions of the solid
    Walls(const Contact& contact, std::vector<Wall> walls);

    std::string name() const override { return "walls"; }
    std::size_t n_history() const override;
    bool irreversible() const override { return restitution_ < 1 || !symmetric(); }
    void initial_history(std::span<double> history) const override;
    void add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                   std::span<double> updated) const override;
    void follow(const Parting& parting, const State& accepted, std::vector<double>& history,
                PathEnergies& energies) override;
    std::vector<std::array<std::int32_t, 2>> couplings() const override;
    bool symmetric() const override;
    void stiffness(const Trial& trial, std::span<const double> history,
                   std::span<ForceTerm::Stiffness> df_du) const override;
    double omega_squared(const Trial& trial, std::span<const double> history,
                         std::span<const double> lumped_mass) const override;
    void add_stiffness_bound(const Trial& trial, std::span<const double> history,
                             std::span<double> bound) const override;
    void add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const override;
    void add_dissipated(std::span<const double> from, std::span<const double> to,
                        PathEnergies& energies) const override;

    /// Lets boundaries that lie on a wall press on it from the start as their elements' stress says; to be called
    /// before initial_history(). Tension gives no force, shear no more than friction holds.
    /// @param stress  Cauchy, of each element, Pa: xx, yy, xy
    void preload(std::span<const std::array<double, 3>> stress);

    /// Of every wall and every body.
    /// @param u  m, shape (2 n_mesh_nodes)
    Gaps gaps(double t, std::span<const double> u) const;
    /// Points in the reference shape that are no further from a wall than the skin of contact; `other` is -1.
    std::vector<ContactPlace> places() const;
    /// How deep a point of the boundary is in one of the walls at most in the reference shape, m; <= 0: in none.
    double deepest_at_rest() const;

private:
    /// In a history, before what points remember: of all walls.
    struct Sums {
        double friction, restitution, work;  ///< J
        double t;                            ///< of the last accepted state, s
        static constexpr std::size_t n = 4;
    };
    struct Response;

    std::size_t place(std::size_t wall, std::size_t point) const;
    double stiffness_of(std::size_t point) const;
    double closer(std::size_t wall, std::size_t point) const {
        return closer_.empty() ? 0 : closer_[wall * points_.size() + point];
    }
    template <class T>
    Vec2<T> force(std::size_t wall, std::size_t point, double t, const Vec2<T>& x, std::span<const double> old,
                  Response& response) const;
    Vec2<double> position(std::size_t point, std::span<const double> u) const;
    template <class Visit>
    void for_each_touch(const Trial& trial, Visit visit) const;
    double bound_of(std::size_t point) const;

    const Contact& contact_;
    std::vector<Wall> walls_;
    ContactorPoints points_;  ///< as the history has them
    // of stress in situ, shape (walls, points); empty: none
    std::vector<double> closer_;  ///< how deep a point on a wall's face is taken to be, m
    std::vector<double> drawn_;   ///< slip of its spring at the start, m
    double restitution_, tangential_factor_, thickness_;
};

/// @throws InputError if a body is inside a wall at the start
std::unique_ptr<Walls> make_walls(const Contact& contact, const std::vector<WallOptions>& walls, double friction);

}  // namespace gneiss
