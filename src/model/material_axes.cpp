#include "model/material_axes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec2.hpp"
#include "mesh/check.hpp"
#include "mesh/measure.hpp"
#include "model/formula.hpp"

namespace gneiss {
namespace {

using Point = std::array<double, 2>;
using Line = std::vector<Point>;

Vec2<double> between(const Point& from, const Point& to) { return {to[0] - from[0], to[1] - from[1]}; }
double length(const Vec2<double>& v) { return std::hypot(v.x, v.y); }

/// A direction without sense, as the unit vector of twice its angle.
Vec2<double> doubled(const Vec2<double>& direction) {
    const double squared = dot(direction, direction);
    return {(direction.x * direction.x - direction.y * direction.y) / squared, 2 * direction.x * direction.y / squared};
}

struct Foot {
    double distance;         ///< m
    Vec2<double> to_point;   ///< from the line to the point
    Vec2<double> direction;  ///< doubled
};

Foot foot_on(const Line& line, const Point& point) {
    std::size_t nearest = 0;
    double position = 0, smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2<double> segment = between(line[i], line[i + 1]), offset = between(line[i], point);
        const double along = std::clamp(dot(segment, offset) / dot(segment, segment), 0.0, 1.0);
        const double distance = length(offset - along * segment);
        if (distance < smallest) {
            smallest = distance;
            nearest = i;
            position = along;
        }
    }
    const Vec2<double> segment = between(line[nearest], line[nearest + 1]);
    Vec2<double> direction = doubled(segment);
    const bool backward = position < 0.5;
    if (backward ? nearest > 0 : nearest + 2 < line.size()) {
        const std::size_t other = backward ? nearest - 1 : nearest + 1;
        const Vec2<double> neighbour = doubled(between(line[other], line[other + 1]));
        const double weight = std::abs(position - 0.5);  // 0 in the middle of the segment, 1/2 at its end
        direction = (1 - weight) * direction + weight * neighbour;
    }
    return {smallest, between(line[nearest], point) - position * segment, direction};
}

}  // namespace

double Bedding::angle(const Point& point) const {
    std::vector<Foot> feet;
    for (const Line& line : lines_) feet.push_back(foot_on(line, point));
    std::sort(feet.begin(), feet.end(), [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
    Vec2<double> direction = feet[0].direction;
    const auto other = std::find_if(feet.begin() + 1, feet.end(),
                                    [&](const Foot& foot) { return dot(foot.to_point, feet[0].to_point) < 0; });
    if (other != feet.end()) {
        const double d1 = feet[0].distance, d2 = other->distance;
        direction = (d2 / (d1 + d2)) * direction + (d1 / (d1 + d2)) * other->direction;
    }
    return 0.5 * std::atan2(direction.y, direction.x);
}

std::vector<double> axis_angles(const Mesh& mesh, std::span<const std::int32_t> elements, const AxesOptions& options,
                                std::vector<Problem>& problems) {
    std::vector<double> angles(elements.size(), 0.0);
    const auto centroids = element_centroids(mesh);
    const auto for_each_centroid = [&](auto&& angle_at) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            angles[i] = angle_at(centroids[static_cast<std::size_t>(elements[i])]);
    };
    switch (options.kind) {
        case AxesOptions::Kind::angle:
            try {
                const CompiledFormula formula(options.angle, "xy");
                for_each_centroid([&](const Point& c) { return formula(c[0], c[1]); });
            } catch (const InputError& error) {
                for (const Problem& problem : error.problems()) problems.push_back({"axes.angle", problem.message});
            }
            break;
        case AxesOptions::Kind::bedding: {
            const Bedding bedding(options.bedding);
            for_each_centroid([&](const Point& c) { return bedding.angle(c); });
            break;
        }
        case AxesOptions::Kind::data: {
            const auto data = mesh.element_data.find(options.data);
            if (data == mesh.element_data.end()) {
                std::string known;
                for (const auto& [name, values] : mesh.element_data) known += (known.empty() ? "" : ", ") + name;
                problems.push_back({"axes.data", fmt::format("the mesh file has no element data `{}`; it has: {}",
                                                             options.data, known.empty() ? "none" : known)});
                break;
            }
            std::vector<std::int64_t> missing;
            for (std::size_t i = 0; i < elements.size(); ++i) {
                const auto e = static_cast<std::size_t>(elements[i]);
                angles[i] = data->second[e];
                if (std::isnan(angles[i])) missing.push_back(mesh.element_labels[e]);
            }
            if (!missing.empty())
                problems.push_back(
                    {"axes.data", fmt::format("element data `{}` of the mesh file have no number for {}: "
                                              "one component is needed, given once",
                                              options.data, numbered("element", missing))});
            break;
        }
    }
    return angles;
}

}  // namespace gneiss
