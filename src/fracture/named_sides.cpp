#include "fracture/named_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "mesh/boundary.hpp"
#include "model/mesh_names.hpp"

namespace gneiss {
namespace {

std::int32_t region_number(const Mesh& mesh, const std::string& name) {
    elements_named(mesh, name);  // throws if there is none
    return static_cast<std::int32_t>(std::ranges::find(mesh.region_names, name) - mesh.region_names.begin());
}

std::vector<std::int32_t> sides_of_line(const Mesh& mesh, const InnerSides& inner, const std::string& name) {
    std::vector<std::int32_t> sides;
    for (const ElementSide& side : inner_line_named(mesh, name)) sides.push_back(inner.number(side));
    return sides;
}

std::vector<std::int32_t> sides_between(const Mesh& mesh, const InnerSides& inner, const std::string& one,
                                        const std::string& other) {
    const std::int32_t a = region_number(mesh, one), b = region_number(mesh, other);
    std::vector<std::int32_t> sides;
    for (std::size_t s = 0; s < inner.sides().size(); ++s) {
        const auto& [left, right] = inner.sides()[s];
        const std::int32_t of_left = mesh.region[static_cast<std::size_t>(left.element)],
                           of_right = mesh.region[static_cast<std::size_t>(right.element)];
        if ((of_left == a && of_right == b) || (of_left == b && of_right == a))
            sides.push_back(static_cast<std::int32_t>(s));
    }
    if (sides.empty())
        throw InputError("",
                         fmt::format("between = [\"{}\", \"{}\"]: these regions have no side in common", one, other));
    return sides;
}

/// Gives sides to entries of the deck, each to one.
class Claims {
public:
    Claims(const Mesh& mesh, const InnerSides& inner)
        : mesh_(mesh), inner_(inner), owner_(inner.sides().size(), nobody) {}

    void claim(std::string entry, const std::vector<std::int32_t>& sides) {
        entries_.push_back(std::move(entry));
        const std::size_t own = entries_.size() - 1;
        std::size_t n_twice = 0;
        std::int32_t first = -1;
        for (const std::int32_t side : sides) {
            std::size_t& owner = owner_[static_cast<std::size_t>(side)];
            if (owner == nobody) {
                owner = own;
            } else {
                if (n_twice == 0) first = side;
                ++n_twice;
            }
        }
        if (n_twice == 0) return;
        const ElementSide& side = inner_.sides()[static_cast<std::size_t>(first)].left;
        const std::int32_t* nodes = mesh_.element(static_cast<std::size_t>(side.element));
        const auto local = side_nodes(mesh_.kind, side.side);
        const auto &a = mesh_.nodes[static_cast<std::size_t>(nodes[local.front()])],
                   &b = mesh_.nodes[static_cast<std::size_t>(nodes[local.back()])];
        throw InputError(
            "", fmt::format("{} of its sides belong to others already: the one from ({:.6g}, {:.6g}) to "
                            "({:.6g}, {:.6g}) m to {}",
                            n_twice, a[0], a[1], b[0], b[1], entries_[owner_[static_cast<std::size_t>(first)]]));
    }

private:
    static constexpr std::size_t nobody = static_cast<std::size_t>(-1);
    const Mesh& mesh_;
    const InnerSides& inner_;
    std::vector<std::string> entries_;
    std::vector<std::size_t> owner_;  ///< of each side, a number in entries_
};

}  // namespace

NamedSides named_sides(const Mesh& mesh, const InnerSides& inner, const std::vector<CrackOptions>& cracks,
                       const std::vector<InterfaceOptions>& interfaces) {
    NamedSides named;
    Claims claims(mesh, inner);
    std::vector<Problem> problems;
    const auto entry = [&](const std::string& place, const std::string& on, auto&& sides_of) {
        try {
            const std::vector<std::int32_t> sides = sides_of();
            claims.claim(on.empty() ? place : fmt::format("{} on = \"{}\"", place, on), sides);
            return sides;
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems()) problems.push_back({place, problem.message});
        }
        return std::vector<std::int32_t>{};
    };
    for (std::size_t c = 0; c < cracks.size(); ++c) {
        const auto sides = entry(fmt::format("[[crack]] {}", c + 1), cracks[c].on,
                                 [&] { return sides_of_line(mesh, inner, cracks[c].on); });
        named.cracked.insert(named.cracked.end(), sides.begin(), sides.end());
    }
    std::ranges::sort(named.cracked);
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        const InterfaceOptions& interface = interfaces[i];
        const auto sides = entry(fmt::format("[[interface]] {}", i + 1), interface.on, [&] {
            return interface.on.empty() ? sides_between(mesh, inner, interface.between.at(0), interface.between.at(1))
                                        : sides_of_line(mesh, inner, interface.on);
        });
        for (const std::int32_t side : sides) named.interface_of.emplace(side, i);
    }
    if (!problems.empty()) throw InputError(std::move(problems));
    return named;
}

void open_cracks(Mesh& mesh, InnerSides& inner, std::span<const std::int32_t> cracked) {
    std::set<std::int32_t> parted;
    for (const NodeCopy& copy : inner.open(cracked)) {
        parted.insert(copy.original);
        parted.insert(copy.copy);
    }
    for (const auto& [name, edges] : mesh.boundaries) {
        if (mesh.inner_lines.contains(name)) continue;  // in part inside: its nodes there are on no edge
        const std::vector<std::int32_t> own = nodes_of(edges);
        std::erase_if(mesh.node_sets[name], [&](std::int32_t node) {
            return parted.contains(node) && !std::ranges::binary_search(own, node);
        });
    }
}

}  // namespace gneiss
