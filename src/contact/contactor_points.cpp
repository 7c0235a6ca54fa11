#include "contact/contactor_points.hpp"

#include "mesh/geometry.hpp"

namespace gneiss {

ContactorPoints contactor_points(std::span<const BoundaryEdge> edges, std::span<const std::array<double, 2>> nodes) {
    ContactorPoints points;
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> point_of(nodes.size(), none);
    const auto append = [&](std::int32_t a, std::int32_t b, double weight_b, double length) {
        points.a.push_back(a);
        points.b.push_back(b);
        points.weight_b.push_back(weight_b);
        points.length.push_back(length);
    };
    for (const BoundaryEdge& edge : edges) {
        const double length =
            distance(nodes[static_cast<std::size_t>(edge.a)], nodes[static_cast<std::size_t>(edge.b)]);
        for (const std::int32_t node : {edge.a, edge.b}) {
            std::int32_t& point = point_of[static_cast<std::size_t>(node)];
            if (point == none) {
                point = static_cast<std::int32_t>(points.size());
                append(node, node, 0, 0);
            }
            points.length[static_cast<std::size_t>(point)] += length / 6;
        }
        points.of_edge.push_back({point_of[static_cast<std::size_t>(edge.a)],
                                  point_of[static_cast<std::size_t>(edge.b)],
                                  static_cast<std::int32_t>(points.size())});
        append(edge.a, edge.b, 0.5, length * 2 / 3);
    }
    return points;
}

std::vector<FormerPoint> former_points(const ContactorPoints& old, const ContactorPoints& now) {
    std::vector<FormerPoint> former(now.size());
    for (std::size_t edge = 0; edge < old.of_edge.size(); ++edge) {
        const auto& points = now.of_edge[edge];
        const double middle = now.length[static_cast<std::size_t>(points[2])];
        const std::array lengths{middle / 4, middle / 4, middle};  // Simpson's
        for (std::size_t k = 0; k < points.size(); ++k) {
            const auto p = static_cast<std::size_t>(points[k]);
            former[p].point = old.of_edge[edge][k];
            former[p].share += lengths[k] / now.length[p];
        }
    }
    return former;
}

}  // namespace gneiss
