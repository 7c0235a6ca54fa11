#pragma once
// Contact of deformable bodies, and of the faces of a crack  [FORMULATION 6].

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/cell_search.hpp"
#include "contact/contact_bodies.hpp"
#include "contact/contact_memory.hpp"
#include "contact/pair_packs.hpp"
#include "model/interaction.hpp"
#include "model/options.hpp"

namespace gneiss {

/// A contactor point inside a body.
struct ContactOverlap {
    std::int64_t node, other_node;  ///< labels of the ends of the point's edge; equal for a point that is a node
    std::int64_t element;           ///< label of the element that it is in
    std::array<double, 2> at;       ///< m
    double depth;                   ///< m
};

/// A contactor point before an edge of a boundary, no further away than the skin.
struct ContactPlace {
    std::int32_t node, other;  ///< of the mesh: one at the point's edge, one at that edge
    Point2 at;                 ///< m
    Vec2<double> normal;       ///< out of what the point is before, of length 1
};

/// Two of the bodies that a mesh has at the start, the lower number first; or a wall, -1 - its number, and a body.
using Touching = std::pair<std::int32_t, std::int32_t>;
/// How far they are apart, m; below zero: how deep a point of one is in the other, or in the wall, at most.
using Gaps = std::map<Touching, double>;

/// Deeper than this part of the shortest edge is no rounding of positions.
inline constexpr double overlap_tolerance = 1e-6;

class Contact final : public Interaction {
public:
    struct Options {
        double thickness = SolidOptions().thickness;        ///< of the solid, m, > 0
        double friction = ContactOptions().friction;        ///< mu, >= 0
        double restitution = ContactOptions().restitution;  ///< e, in (0, 1]
        double tangential_factor =
            ContactOptions().tangential_factor;  ///< tangential stiffness over the normal one, > 0
        double skin = 0;                         ///< m, > 0: pairs are complete until a node has moved half of it
        /// Whether sides may fail later: what overlaps then is remembered, and pushed apart no further.
        bool comes_apart = false;
        /// @throws InputError
        void validate() const;
    };

    /// Contact searches at once, in the reference shape.
    Contact(const PartedMesh& start, std::span<const double> layers, double cap, const Options& options);

    std::string name() const override { return "contact"; }
    std::size_t n_history() const override { return remembers_ ? Memory::size(bodies_.points().size()) : 0; }
    void initial_history(std::span<double> history) const override;
    /// Pairs that are not complete at the trial are searched again there: what is in touch, and its force, do not
    /// depend on when that was. Not so once somebody has asked for couplings(): a tangent's pattern has to hold.
    /// @throws RecoverableError if a point is deeper than its potential reaches, or, with couplings() asked for, a node
    /// has moved further than pairs were searched for; the message names it and the time
    void add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                   std::span<double> updated) const override;
    /// Displacements of the accepted state are those of the parted mesh already. Points that are in a body only because
    /// something has come apart get a rest depth: no force and no energy comes into being.
    void follow(const Parting& parting, const State& accepted, std::vector<double>& history,
                PathEnergies& energies) override;
    bool watches() const override { return true; }
    /// Keeps couplings() complete for the next step, once somebody has asked for them.
    bool look(const State& accepted) override;
    bool renew(const State& accepted) override;
    std::vector<std::array<std::int32_t, 2>> couplings() const override;
    /// Without friction it is the second derivative of an energy.
    bool symmetric() const override { return options_.friction == 0; }
    void stiffness(const Trial& trial, std::span<const double> history,
                   std::span<ForceTerm::Stiffness> df_du) const override;
    double omega_squared(const Trial& trial, std::span<const double> history,
                         std::span<const double> lumped_mass) const override;
    void add_stiffness_bound(const Trial& trial, std::span<const double> history,
                             std::span<double> bound) const override;
    void add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const override;
    void add_dissipated(std::span<const double> from, std::span<const double> to,
                        PathEnergies& energies) const override;

    /// Points that are deeper than `tolerance` (m) inside a body, by ascending point.
    /// @param u  m, shape (2 n_mesh_nodes)
    std::vector<ContactOverlap> overlaps(std::span<const double> u, double tolerance) const;
    /// Of all pairs of bodies that the last search has found near each other.
    /// @param u  m, shape (2 n_mesh_nodes)
    Gaps gaps(std::span<const double> u) const;
    /// Of all pairs that the last search has found near each other; those within one body, faces of cracks, as well.
    /// @param u  m, shape (2 n_mesh_nodes)
    std::vector<ContactPlace> places(std::span<const double> u) const;
    const ContactBodies& bodies() const { return bodies_; }
    const Options& options() const { return options_; }
    // What the last evaluation met, and how often pairs were searched: for reports.
    std::size_t n_candidates() const { return candidates_.pairs.size(); }
    std::size_t n_touching() const { return hits_.size(); }
    std::size_t n_searches() const { return n_searches_; }

private:
    using Memory = ContactMemory<double>;
    using AcceptedMemory = ContactMemory<const double>;

    /// @param u  displacements of the bonded nodes, m, or of more behind them
    void search(std::span<const double> u) const;
    bool search_at(std::span<const double> u);
    /// Constants of the mesh as it is.
    void take_constants();
    // In what follows displacements are those of the bonded nodes.
    double largest_motion(std::span<const double> u, std::span<const double> since) const;
    void search_if_stale(std::span<const double> u) const;
    std::span<const double> bonded(std::span<const double> u_of_mesh) const {
        return bodies_.displacements(u_of_mesh, u_);
    }
    void find_hits(std::span<const double> u) const;
    /// Which slot of its point each pair in touch has. @return energy of springs that nothing holds any more, J
    double match(std::span<const double> history) const;
    LoadedPairs load(std::size_t first, std::span<const double> history) const;
    double stiffness_of(const ContactCandidate& pair) const;
    ContactResponse<double, double> alone(const ContactCandidate& pair, double k) const;
    std::size_t respond(std::span<const double> history, std::span<double> updated) const;
    double stored(std::span<const double> u, std::span<const double> history) const;
    void bound_stiffness(std::span<const double> u) const;
    bool adjacent(std::int32_t triangle, std::int32_t other) const;
    std::array<std::int32_t, nodes_per_candidate> nodes_of(const ContactCandidate& pair) const;
    /// One of the mesh's nodes that a pair acts on.
    struct Held {
        std::int32_t node;
        std::size_t local;  ///< which of nodes_of() holds it
        double share;
    };
    void held_by(const ContactCandidate& pair, std::vector<Held>& nodes) const;
    std::vector<double> keep_forces(std::span<const double> u, const std::vector<double>& depths,
                                    std::span<const FormerPoint> former, const std::vector<double>& history);
    std::vector<double> settled(std::span<const double> u, const std::vector<double>& history);
    [[noreturn]] void refuse_deep(const Trial& trial, std::size_t hit) const;

    Options options_;
    bool remembers_;
    ContactBodies bodies_;
    std::vector<TargetConstants> targets_;  ///< by triangle
    std::vector<PointConstants> points_;    ///< by contactor point

    // pairs: a cache, whose age changes no force
    mutable CellSearch search_;
    mutable CandidatePacks candidates_;
    mutable std::vector<double> searched_;  ///< displacements of the bonded nodes at the last search, m
    mutable std::size_t n_searches_ = 0;

    // where tangents are wanted
    mutable bool coupled_ = false;                     ///< couplings() has been asked for
    mutable std::vector<std::size_t> first_coupling_;  ///< of each candidate, in couplings()
    std::vector<double> looked_u_;                     ///< displacements at the last look, m
    std::optional<double> looked_at_;                  ///< its time, s
    double longest_dt_ = 0;                            ///< of the last steps, s

    // scratch of one evaluation
    mutable std::vector<double> u_, f_;        ///< of the bonded nodes, m, N, where they are not the mesh's
    mutable std::vector<double> x_, point_x_;  ///< current positions of bonded nodes and points, m
    mutable std::vector<std::vector<std::int32_t>> found_;  ///< candidates in touch, per range of packs
    mutable std::vector<std::int32_t> hits_;                ///< candidates in touch, ascending
    mutable std::vector<std::int8_t> slots_;                ///< per hit: of its point; -1: none was free
    mutable std::vector<std::uint8_t> known_;               ///< per hit: whether the slot's history is its own
    mutable std::vector<PairNumber> hit_nodes_;             ///< shape (packs of hits, 5, lanes)
    mutable AlignedDoubles forces_;                         ///< N, shape (packs of hits, 10, lanes)
    mutable AlignedDoubles stored_, slid_, lost_;           ///< J, per hit: stored; dissipated by friction, restitution
    mutable std::vector<double> bound_, target_bound_;      ///< N/m, per bonded node
};

}  // namespace gneiss
