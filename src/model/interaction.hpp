#pragma once
// Forces between parts of a solid that may remember what has been: joints of cracks, contact.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/inner_sides.hpp"
#include "model/force_term.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// How a mesh has come apart between two steps.
struct Parting {
    const Mesh& mesh;                        ///< as it is now
    std::span<const NodeCopy> copies;        ///< nodes that have come into being, in the order of their numbers
    std::span<const std::int32_t> elements;  ///< at originals and copies, ascending: their nodes may have changed
    std::span<const std::int32_t>
        opened;  ///< inner sides that have opened: their nodes may part, a cohesion holds them
    std::span<const std::int32_t> failed;  ///< inner sides that nothing holds any more: contact takes over
};

/// All of it is a function of a trial state and of the accepted history, its own part of State::history.
class Interaction {
public:
    virtual ~Interaction() = default;
    virtual std::string name() const = 0;

    virtual std::size_t n_history() const = 0;
    /// @param[out] history  overwritten, shape (n_history)
    virtual void initial_history(std::span<double> history) const = 0;

    /// Adds its forces, N, to f of shape (2 n_nodes), with the same bits for any number of threads.
    /// @param history       accepted, shape (n_history)
    /// @param[out] updated  what accepting the trial would leave, same shape; empty: not wanted
    virtual void add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                           std::span<double> updated) const = 0;

    /// Elements are evaluated chunk by chunk. What acts between nodes that one chunk alone has can follow it at once,
    /// while these nodes are in a near cache: where an interaction takes chunks, add_chunk_force() adds that, and
    /// add_force() the rest.
    /// @param chunk_of_node  -1: several chunks have it
    virtual void take_chunks(std::span<const std::int32_t> chunk_of_node, std::size_t n_chunks) {
        (void)chunk_of_node;
        (void)n_chunks;
    }
    /// As add_force(), for one chunk; called in threads for several chunks at a time.
    virtual void add_chunk_force(std::size_t chunk, const Trial& trial, std::span<const double> history,
                                 std::span<double> f, std::span<double> updated) const {
        (void)chunk;
        (void)trial;
        (void)history;
        (void)f;
        (void)updated;
    }

    /// Follows a mesh that has come apart: nodes, couplings, and, in an accepted state, its history.
    /// @param history  its own part, at its old size; left at the new one
    /// @param energies  takes what stored energy jumps by, in `splitting`
    virtual void follow(const Parting& parting, const State& accepted, std::vector<double>& history,
                        PathEnergies& energies) = 0;

    /// Whether its history is, or may become, one that a step back in time would not undo.
    virtual bool irreversible() const { return n_history() > 0; }

    /// Whether look() is to be called.
    virtual bool watches() const { return false; }
    /// Event::stirred() for look().
    virtual bool stirred(const State& state) const {
        (void)state;
        return true;
    }
    /// Called before the first step and after every accepted one: what it then finds (a search of contacts) holds until
    /// the next call.
    /// @return whether couplings() have changed
    virtual bool look(const State& accepted) {
        (void)accepted;
        return false;
    }

    /// Event::renew() for it.
    /// @return whether couplings() have changed
    virtual bool renew(const State& accepted) {
        (void)accepted;
        return false;
    }

    /// Pairs of nodes (a, b) where the force on a may depend on the displacement of b, in any order; a pair may occur
    /// more than once.
    virtual std::vector<std::array<std::int32_t, 2>> couplings() const = 0;
    /// Whether df/du is, in every state.
    virtual bool symmetric() const = 0;
    /// df_a/du_b with the history following the displacements, N/m.
    /// @param[out] df_du  overwritten, in the order of couplings()
    virtual void stiffness(const Trial& trial, std::span<const double> history,
                           std::span<ForceTerm::Stiffness> df_du) const = 0;

    /// Upper bound of the eigenvalues of -M^-1 df/du, (rad/s)^2, M the whole lumped mass of the solid.
    virtual double omega_squared(const Trial& trial, std::span<const double> history,
                                 std::span<const double> lumped_mass) const = 0;
    /// Adds to the diagonal of a matrix D with x.K x <= x.D x for K = -df/du, N/m, shape (2 n_nodes).
    virtual void add_stiffness_bound(const Trial& trial, std::span<const double> history,
                                     std::span<double> bound) const = 0;

    /// Adds what it stores in an accepted state.
    virtual void add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const = 0;
    /// Adds what it has dissipated between two accepted states.
    virtual void add_dissipated(std::span<const double> history_from, std::span<const double> history_to,
                                PathEnergies& energies) const = 0;
};

/// Those of a solid, one behind the other, with their parts of State::history.
class Interactions {
public:
    Interactions() = default;
    /// @param history_offset  of the first one in State::history
    Interactions(std::vector<std::unique_ptr<Interaction>> all, std::size_t history_offset);

    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    const Interaction& operator[](std::size_t i) const { return *all_[i]; }
    /// @param interaction  one of them
    std::span<double> part(const Interaction& interaction, State& state) const;
    bool irreversible() const;
    bool watch() const;
    bool stirred(const State& state) const;
    /// Interaction::look() of all of them.
    bool look(const State& accepted);
    /// Interaction::renew() of all of them.
    bool renew(const State& accepted);
    /// Interaction::follow() of all of them; the state's history becomes theirs.
    void follow(const Parting& parting, State& accepted);
    std::size_t n_history() const { return starts_.back() - starts_.front(); }
    /// Its part of a whole history; empty for an empty one.
    template <class T>
    std::span<T> part(std::size_t i, std::span<T> history) const {
        return history.empty() ? history : history.subspan(starts_[i], starts_[i + 1] - starts_[i]);
    }

    void initial_history(std::span<double> history) const;
    /// @param[out] updated  whole history; empty: not wanted
    void add_force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> updated) const;
    void take_chunks(std::span<const std::int32_t> chunk_of_node, std::size_t n_chunks);
    void add_chunk_force(std::size_t chunk, const State& accepted, const Trial& trial, std::span<double> f,
                         std::span<double> updated) const;
    double omega_squared(const State& accepted, const Trial& trial, std::span<const double> lumped_mass) const;
    void add_stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const;
    void add_stored(const State& state, StoredEnergies& energies) const;
    void add_dissipated(const State& from, State& to) const;

private:
    std::span<const double> part(std::size_t i, const State& state) const {
        return part(i, std::span<const double>(state.history));
    }

    std::vector<std::unique_ptr<Interaction>> all_;
    std::vector<std::size_t> starts_{0};  ///< in State::history, shape (size + 1)
};

}  // namespace gneiss
