#include "mesh/crossed_lines.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <optional>

#include "mesh/geometry.hpp"

namespace gneiss {
namespace {

/// An end that is this close to the other line, relative to the shorter of the two, touches it: a hundred times Gmsh's
/// own tolerance of geometry.
constexpr double touching = 1e-6;

struct StraightLine {
    int curve;
    bool of_outline;
    Point2 from, to;

    double low_x() const { return std::min(from[0], to[0]); }
    double high_x() const { return std::max(from[0], to[0]); }
};

std::optional<StraightLine> straight_line(int curve, bool of_outline) {
    std::string type;
    gmsh::model::getType(1, curve, type);
    if (type != "Line") return std::nullopt;
    gmsh::vectorpair ends;
    gmsh::model::getBoundary({{1, curve}}, ends, false, false, false);
    if (ends.size() != 2) return std::nullopt;
    const auto at = [](int point) -> Point2 {
        std::vector<double> x;
        gmsh::model::getValue(0, point, {}, x);
        return {x.at(0), x.at(1)};
    };
    const StraightLine line{curve, of_outline, at(ends[0].second), at(ends[1].second)};
    // "Line" may be a chain of several points: only one that stays on its chord is straight
    std::vector<double> low, high, x;
    gmsh::model::getParametrizationBounds(1, curve, low, high);
    constexpr int n_samples = 16;
    for (int k = 1; k < n_samples; ++k) {
        gmsh::model::getValue(1, curve, {low.at(0) + (high.at(0) - low.at(0)) * k / n_samples}, x);
        if (distance_to_edge({x.at(0), x.at(1)}, line.from, line.to) > touching * distance(line.from, line.to))
            return std::nullopt;
    }
    return line;
}

std::vector<StraightLine> lines_of(int surface) {
    gmsh::vectorpair outline, embedded;
    gmsh::model::getBoundary({{2, surface}}, outline, false, false, false);
    gmsh::model::mesh::getEmbedded(2, surface, embedded);
    std::vector<StraightLine> lines;
    const auto take = [&](const gmsh::vectorpair& entities, bool of_outline) {
        for (const auto& [dim, curve] : entities)
            if (dim == 1)
                if (const auto line = straight_line(curve, of_outline)) lines.push_back(*line);
    };
    take(outline, true);
    take(embedded, false);
    std::ranges::sort(lines, {}, &StraightLine::low_x);
    return lines;
}

/// The point at which two lines cross between their ends, if they do.
std::optional<Point2> crossing(const StraightLine& a, const StraightLine& b) {
    const double length_a = distance(a.from, a.to), length_b = distance(b.from, b.to);
    const double a_from = triangle_area(b.from, b.to, a.from), a_to = triangle_area(b.from, b.to, a.to);
    const double b_from = triangle_area(a.from, a.to, b.from), b_to = triangle_area(a.from, a.to, b.to);
    // half a distance times a length is an area
    const double least = 0.5 * touching * std::min(length_a, length_b);
    if (std::min(std::abs(a_from), std::abs(a_to)) <= least * length_b) return std::nullopt;
    if (std::min(std::abs(b_from), std::abs(b_to)) <= least * length_a) return std::nullopt;
    if ((a_from > 0) == (a_to > 0) || (b_from > 0) == (b_to > 0)) return std::nullopt;
    const double t = a_from / (a_from - a_to);
    return Point2{a.from[0] + t * (a.to[0] - a.from[0]), a.from[1] + t * (a.to[1] - a.from[1])};
}

}  // namespace

std::vector<Problem> crossed_outlines(const std::string& where) {
    std::vector<Problem> problems;
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    for (const auto& [dim, surface] : surfaces) {
        const std::vector<StraightLine> lines = lines_of(surface);
        std::size_t n_crossings = 0;
        std::string first;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            for (std::size_t j = i + 1; j < lines.size() && lines[j].low_x() <= lines[i].high_x(); ++j) {
                if (!lines[i].of_outline && !lines[j].of_outline) continue;
                const auto at = crossing(lines[i], lines[j]);
                if (!at || n_crossings++ > 0) continue;
                const auto [low, high] = std::minmax(lines[i].curve, lines[j].curve);
                first = fmt::format("lines {} and {} cross at ({:.6g}, {:.6g}) m", low, high, (*at)[0], (*at)[1]);
            }
        }
        if (n_crossings > 0)
            problems.push_back(
                {where,
                 fmt::format("surface {}: {} without a common point{}: split them there, or end "
                             "them on the outline",
                             surface, first, n_crossings == 1 ? "" : fmt::format(" ({} crossings)", n_crossings))});
    }
    return problems;
}

}  // namespace gneiss
