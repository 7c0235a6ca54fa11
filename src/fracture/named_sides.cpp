#include "fracture/named_sides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "base/suggest.hpp"
#include "mesh/boundary.hpp"
#include "mesh/regions.hpp"
#include "model/mesh_names.hpp"

namespace gneiss {
namespace {

std::vector<std::int32_t> sides_of_line(const Mesh& mesh, const InnerSides& inner, const std::string& name) {
    std::vector<std::int32_t> sides;
    for (const ElementSide& side : inner_line_named(mesh, name)) sides.push_back(inner.number(side));
    return sides;
}

bool is_in(const Mesh& mesh, std::int32_t element, const std::vector<bool>& regions) {
    return regions[static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(element)])];
}

/// Sides where two of these regions meet: each element is in one of them in which the other is not. What lies in both
/// of two groups that overlap is on neither side of a boundary between them.
std::vector<std::int32_t> sides_between(const Mesh& mesh, const InnerSides& inner,
                                        const std::vector<std::string>& names) {
    std::vector<std::set<std::size_t>> names_of(mesh.region_names.size());  // of each region, by their places
    for (std::size_t i = 0; i < names.size(); ++i) {
        elements_named(mesh, names[i]);  // throws if there are none
        for (const std::int32_t region : regions_named(mesh, names[i]))
            names_of[static_cast<std::size_t>(region)].insert(i);
    }
    const auto of = [&](const ElementSide& side) -> const std::set<std::size_t>& {
        return names_of[static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(side.element)])];
    };
    std::vector<std::int32_t> sides;
    for (std::size_t s = 0; s < inner.sides().size(); ++s) {
        const std::set<std::size_t>&left = of(inner.sides()[s].left), &right = of(inner.sides()[s].right);
        if (!std::ranges::includes(left, right) && !std::ranges::includes(right, left))
            sides.push_back(static_cast<std::int32_t>(s));
    }
    return sides;
}

std::vector<std::int32_t> sides_of_interface(const Mesh& mesh, const InnerSides& inner,
                                             const InterfaceOptions& interface) {
    if (!interface.on.empty()) return sides_of_line(mesh, inner, interface.on);
    const std::vector<std::string> names = interface.between_any ? names_of_regions(mesh) : interface.between;
    std::vector<std::int32_t> sides = sides_between(mesh, inner, names);
    if (sides.empty())
        throw InputError("", interface.between_any
                                 ? std::string("between = \"any\": no two regions of the mesh have a side in common")
                                 : fmt::format("between = [\"{}\"]: these regions have no side in common",
                                               fmt::join(names, "\", \"")));
    return sides;
}

/// Sides that may not crack: neither within the regions, nor on the lines, nor of an interface, nor open already.
std::vector<std::int32_t> bonded_sides(const Mesh& mesh, const InnerSides& inner, const std::vector<std::string>& on,
                                       const NamedSides& named, std::vector<Problem>& problems) {
    std::vector<bool> may_crack(inner.sides().size(), false), regions(mesh.region_names.size(), false);
    for (const std::string& name : on) {
        const std::vector<std::int32_t> numbers = regions_named(mesh, name);
        for (const std::int32_t region : numbers) regions[static_cast<std::size_t>(region)] = true;
        const bool is_line = mesh.inner_lines.contains(name);
        if (is_line)
            for (const std::int32_t side : sides_of_line(mesh, inner, name))
                may_crack[static_cast<std::size_t>(side)] = true;
        if (!numbers.empty() || is_line) continue;
        std::vector<std::string> known = names_of_regions(mesh);
        for (const auto& [line, unused] : mesh.inner_lines) known.push_back(line);
        problems.push_back({"[fracture] on",
                            fmt::format("the mesh has no region and no line inside the solid of the name "
                                        "\"{}\"; there are: {}{}",
                                        name, fmt::join(known, ", "), suggestion(name, {known.begin(), known.end()}))});
    }
    for (const auto& [side, unused] : named.interface_of) may_crack[static_cast<std::size_t>(side)] = true;
    std::vector<std::int32_t> bonded;
    for (std::size_t s = 0; s < inner.sides().size(); ++s) {
        const auto& [left, right] = inner.sides()[s];
        if (may_crack[s] || (is_in(mesh, left.element, regions) && is_in(mesh, right.element, regions))) continue;
        const auto number = static_cast<std::int32_t>(s);
        if (!std::ranges::binary_search(named.cracked, number)) bonded.push_back(number);
    }
    if (problems.empty() && bonded.size() + named.cracked.size() == inner.sides().size())
        problems.push_back({"[fracture] on", "no side may crack: it names none, and there is no [[interface]]"});
    return bonded;
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
                       const std::vector<InterfaceOptions>& interfaces,
                       const std::optional<std::vector<std::string>>& where) {
    NamedSides named;
    Claims claims(mesh, inner);
    std::vector<Problem> problems;
    const auto entry = [&](const std::string& place, const std::string& line, auto&& sides_of) {
        try {
            const std::vector<std::int32_t> sides = sides_of();
            claims.claim(line.empty() ? place : fmt::format("{} on = \"{}\"", place, line), sides);
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
        const auto sides = entry(fmt::format("[[interface]] {}", i + 1), interface.on,
                                 [&] { return sides_of_interface(mesh, inner, interface); });
        for (const std::int32_t side : sides) named.interface_of.emplace(side, i);
    }
    if (where) named.bonded = bonded_sides(mesh, inner, *where, named, problems);
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
