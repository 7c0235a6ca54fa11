#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/generators.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/gmsh_session.hpp"

namespace gneiss {
namespace {

using std::numbers::pi;

/// Point k of n on the square about the origin, counter-clockwise from (side/2, 0), n a multiple of 8: each side is
/// divided evenly.
Point2 on_square(int k, int n, double side) {
    const int per_side = n / 4;
    const int shifted = (k + per_side / 2) % n;  // counted from the lower right corner
    const double along = side * (static_cast<double>(shifted % per_side) / per_side - 0.5);
    const double half = side / 2;
    switch (shifted / per_side) {
        case 0:
            return {half, along};
        case 1:
            return {-along, half};
        case 2:
            return {-half, -along};
        default:
            return {along, -half};
    }
}

const char* side_of_square(int k, int n) {
    constexpr std::array names{"right", "top", "left", "bottom"};
    return names[static_cast<std::size_t>((k + n / 8) % n / (n / 4))];
}

/// Part of the way from hole to square at ring i of n, for edges that grow linearly with the distance: geometric.
double ring_position(const MeshOptions& options, int i, int n) {
    const double growth = options.size[1] / options.size[0];
    const double s = static_cast<double>(i) / n;
    // Equal sizes make 0/0; a growth that close to 1 is even division to round-off.
    if (std::abs(growth - 1) < 1e-8) return s;
    return std::expm1(s * std::log(growth)) / (growth - 1);
}

}  // namespace

double plate_edge_length(const MeshOptions& options, double r) {
    const double way = (r - options.radius) / (options.side / 2 - options.radius);
    return std::lerp(options.size[0], options.size[1], std::clamp(way, 0.0, 1.0));
}

PlateDivision plate_division(const MeshOptions& options) {
    const double around = std::max(2 * pi * options.radius / options.size[0], 4 * options.side / options.size[1]);
    const double depth = options.side / 2 - options.radius;
    const double growth = options.size[1] - options.size[0];
    // Number of edges whose length grows linearly: the integral of dr / h(r). Equal sizes make 0/0.
    const double rings = std::abs(growth) < 1e-8 * options.size[0]
                             ? depth / options.size[0]
                             : depth / growth * std::log(options.size[1] / options.size[0]);
    // A count that is whole but for round-off stays what it is.
    constexpr double round_off = 1e-9;
    return {8 * std::ceil(around / 8 - round_off), std::max(1.0, std::ceil(rings - round_off))};
}

MeshDraft structured_plate_with_hole(const MeshOptions& options) {
    const PlateDivision division = plate_division(options);
    const int n = static_cast<int>(division.around), n_rings = static_cast<int>(division.rings);
    MeshDraft draft;
    draft.region_names = {"solid"};
    for (int ring = 0; ring <= n_rings; ++ring) {
        const double t = ring_position(options, ring, n_rings);
        for (int k = 0; k < n; ++k) {
            const double angle = 2 * pi * k / n;
            const Point2 outside = on_square(k, n, options.side);
            draft.add_node(std::lerp(options.radius * std::cos(angle), outside[0], t),
                           std::lerp(options.radius * std::sin(angle), outside[1], t));
        }
    }
    const auto node = [n](int ring, int k) { return static_cast<std::int32_t>(ring * n + k % n); };
    for (int ring = 0; ring < n_rings; ++ring)
        for (int k = 0; k < n; ++k) {
            const std::array corners{node(ring, k), node(ring + 1, k), node(ring + 1, k + 1), node(ring, k + 1)};
            const int first = (ring + k) % 2;
            draft.add_triangle(corners[first], corners[first + 1], corners[first + 2]);
            draft.add_triangle(corners[first], corners[first + 2], corners[(first + 3) % 4]);
        }
    for (int k = 0; k < n; ++k) {
        draft.lines["hole"].push_back({node(0, k + 1), MeshDraft::no_node, node(0, k)});
        for (const char* name : {side_of_square(k, n), "outer"})
            draft.lines[name].push_back({node(n_rings, k), MeshDraft::no_node, node(n_rings, k + 1)});
    }
    draft.points = {{"top_right", {node(n_rings, n / 8)}},
                    {"top_left", {node(n_rings, 3 * n / 8)}},
                    {"bottom_left", {node(n_rings, 5 * n / 8)}},
                    {"bottom_right", {node(n_rings, 7 * n / 8)}}};
    add_mid_sides(draft);
    if (options.curved) follow_circle(draft, "hole", options.radius);
    return draft;
}

MeshDraft free_plate_with_hole(const MeshOptions& options) {
    GmshSession session;
    MeshDraft draft = session.run("mesh", [&] {
        namespace geo = gmsh::model::geo;
        gmsh::model::add("plate_with_hole");
        const double half = options.side / 2;
        const std::array corners{geo::addPoint(-half, -half, 0), geo::addPoint(half, -half, 0),
                                 geo::addPoint(half, half, 0), geo::addPoint(-half, half, 0)};
        std::array<int, 4> sides;
        for (std::size_t i = 0; i < 4; ++i) sides[i] = geo::addLine(corners[i], corners[(i + 1) % 4]);

        // Three arcs of an odd number of edges each: an odd number in all cannot be mapped to itself by 90 degrees.
        constexpr int n_arcs = 3;
        const double edges_per_arc = 2 * pi * options.radius / (n_arcs * options.size[0]);
        const int n_edges = std::max(3, 2 * static_cast<int>(std::lround((edges_per_arc - 1) / 2)) + 1);
        // The golden ratio spreads the seeds over the circle without ever repeating a division.
        const double turns = 0.1 + options.seed * std::numbers::phi;
        const double start = 2 * pi * (turns - std::floor(turns));
        const int centre = geo::addPoint(0, 0, 0);
        std::array<int, n_arcs> ends, arcs;
        for (std::size_t i = 0; i < n_arcs; ++i) {
            const double angle = start + 2 * pi * static_cast<double>(i) / n_arcs;
            ends[i] = geo::addPoint(options.radius * std::cos(angle), options.radius * std::sin(angle), 0);
        }
        for (std::size_t i = 0; i < n_arcs; ++i) arcs[i] = geo::addCircleArc(ends[i], centre, ends[(i + 1) % n_arcs]);
        const std::vector<int> outer(sides.begin(), sides.end()), hole(arcs.begin(), arcs.end());
        const int surface = geo::addPlaneSurface({geo::addCurveLoop(outer), geo::addCurveLoop(hole)});
        geo::synchronize();
        for (int arc : arcs) gmsh::model::mesh::setTransfiniteCurve(arc, n_edges + 1);

        const auto name = [](int dim, const std::vector<int>& tags, const char* text) {
            gmsh::model::setPhysicalName(dim, gmsh::model::addPhysicalGroup(dim, tags), text);
        };
        name(2, {surface}, "solid");
        name(1, hole, "hole");
        name(1, outer, "outer");
        constexpr std::array side_names{"bottom", "right", "top", "left"};
        constexpr std::array corner_names{"bottom_left", "bottom_right", "top_right", "top_left"};
        for (std::size_t i = 0; i < 4; ++i) {
            name(1, {sides[i]}, side_names[i]);
            name(0, {corners[i]}, corner_names[i]);
        }

        gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
        gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
        constexpr int frontal_delaunay = 6;  // the most regular triangles of Gmsh's algorithms
        gmsh::option::setNumber("Mesh.Algorithm", frontal_delaunay);
        // z, and in newer versions of Gmsh the size there would be otherwise
        gmsh::model::mesh::setSizeCallback(
            [&options](int, int, double x, double y, auto...) { return plate_edge_length(options, std::hypot(x, y)); });
        gmsh::model::mesh::generate(2);
        gmsh::model::mesh::removeSizeCallback();
        return draft_of_current_model("mesh");
    });
    draft.report_unused_nodes = false;  // Gmsh puts a node at the centre of the arcs
    add_mid_sides(draft);
    if (options.curved) follow_circle(draft, "hole", options.radius);
    return draft;
}

void follow_circle(MeshDraft& draft, const std::string& line, double radius) {
    for (const auto& side : draft.lines.at(line))
        for (std::int32_t node : side) {
            Point2& x = draft.nodes[node];
            const double r = std::hypot(x[0], x[1]);
            for (double& component : x) component *= radius / r;
        }
}

}  // namespace gneiss
