#pragma once
// A rigid platen on a boundary: a drop hammer, the head of a testing machine  [FORMULATION 8].
//
// It moves along its direction n by q and pushes every node of the boundary through its share of a spring and a damper,
// the node's part of the boundary's length in the reference shape; the shape of the platen is the initial one of the
// boundary. With d_i = q - gap - n.u_i and k_i = k l_i/L,
//
//     f_i = n (k_i d_i + c_i d_i'),   m q'' = F(t) - sum (k_i d_i + c_i d_i') - k_g q
//
// where d_i >= 0, or anywhere if the two are bonded. There is no friction between them. The displacement q of a mass is
// the first component of a point of its own; the second one is held by the same springs, and nothing pushes it. That
// of an actuator is given.

#include <memory>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/amplitude.hpp"
#include "model/lumped_model.hpp"
#include "model/options.hpp"

namespace gneiss {

class Platen final : public LumpedModel {
public:
    /// @param options  of a mass or an actuator
    /// @param course   of its amplitude
    /// @throws InputError with empty `where` for a direction without length or a faulty amplitude
    Platen(const LumpedOptions& options, const Mesh& mesh, const std::vector<BoundaryEdge>& edges,
           std::shared_ptr<const AmplitudeCourse> course = nullptr);

    const std::string& name() const override { return options_.name; }
    std::optional<Point> point() const override;
    void place_point(std::int32_t node) override { point_ = node; }

    void add_force(const Trial& at, std::span<double> f) const override;
    bool depends_on_velocity() const override { return options_.damping > 0; }
    std::vector<std::array<std::int32_t, 2>> couplings() const override;
    void stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_du) const override;
    void velocity_stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_dv) const override;
    Rates largest_rates(const Trial& at, std::span<const double> lumped_mass) const override;
    void add_stiffness_bound(const Trial& at, std::span<double> bound) const override;
    /// Of the springs.
    double stored_energy(const Trial& at) const override;
    void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const override;
    std::vector<double> switch_times() const override { return amplitude_.switch_times(); }
    std::vector<Quantity> quantities(const Trial& at) const override;

private:
    struct Touch {
        std::int32_t node;
        double share;  ///< of the boundary's length
    };
    bool moves() const { return options_.kind == LumpedOptions::Kind::mass; }
    double displacement(const Trial& at) const;
    double velocity(const Trial& at) const;
    double driving_force(const Trial& at) const;
    struct Push {
        double depth, rate;     ///< d_i, m, and d_i', m/s
        double spring, damper;  ///< of the whole boundary, N
        bool lets_go;           ///< the damper would pull, and does no more than hold the spring
    };
    /// Calls body(i, push) for every node that is touched.
    template <class Body>
    void for_each_pressed(const Trial& at, Body body) const;
    /// What it pushes the boundary with, N.
    double force(const Trial& at) const;
    /// What the damper takes, W.
    double damping_power(const Trial& at) const;
    /// -df/d(u or v) for springs or dampers of these constants, N/m or N s/m.
    void derivative(const Trial& at, double between, double ground, std::span<ForceTerm::Stiffness> df) const;

    LumpedOptions options_;
    Amplitude amplitude_;
    Vec2<double> direction_;
    std::vector<Touch> touches_;
    std::int32_t point_ = -1;  ///< of a mass
};

}  // namespace gneiss
