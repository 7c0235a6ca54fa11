#pragma once
// What the tests of meshes share.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>

#include "base/errors.hpp"
#include "mesh/geometry.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/measure.hpp"
#include "mesh/sub_triangles.hpp"

namespace gneiss::testing {

/// Sums over at most a few thousand elements of size-one geometry: round-off, some thousand times 1e-16.
inline constexpr double round_off = 1e-12;

/// A folder of its own for each test, gone with it.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "gneiss-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    const std::filesystem::path& path() const { return path_; }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

private:
    std::filesystem::path path_;
};

inline double total_area(const Mesh& mesh) {
    const std::vector<double> areas = element_areas(mesh);
    return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// Smallest signed area over all sub-triangles, seen counter-clockwise, m2.
inline double smallest_signed_area(const Mesh& mesh) {
    double smallest = 1e300;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (std::size_t sub = 0; sub < sub_triangles(mesh.kind).size(); ++sub) {
            std::array<int, 3> n = triangle_nodes(mesh, e, static_cast<int>(sub));
            if (mesh.kind == ElementKind::compt) std::swap(n[0], n[1]);
            smallest = std::min(smallest, triangle_area(mesh.nodes[n[0]], mesh.nodes[n[1]], mesh.nodes[n[2]]));
        }
    return smallest;
}

inline double length(const Mesh& mesh, const BoundaryEdge& edge) {
    return distance(mesh.nodes[edge.a], mesh.nodes[edge.b]);
}

inline double length(const Mesh& mesh, const std::string& boundary) {
    double sum = 0;
    for (const BoundaryEdge& edge : mesh.boundaries.at(boundary)) sum += length(mesh, edge);
    return sum;
}

/// Outward normal as mesh.hpp defines it.
inline Point2 normal(const Mesh& mesh, const BoundaryEdge& edge) {
    const Point2 &p = mesh.nodes[edge.a], &q = mesh.nodes[edge.b];
    const double l = distance(p, q);
    return {(q[1] - p[1]) / l, -(q[0] - p[0]) / l};
}

/// Every edge belongs to its element and has it on the left.
inline void expect_sound_boundaries(const Mesh& mesh) {
    for (const auto& [name, edges] : mesh.boundaries)
        for (const BoundaryEdge& edge : edges) {
            const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(edge.element));
            const int n = mesh.nodes_per_element();
            bool walks_it = false;
            for (int i = 0; i < n; ++i) walks_it = walks_it || (nodes[i] == edge.a && nodes[(i + 1) % n] == edge.b);
            EXPECT_TRUE(walks_it) << name << ": " << edge.a << " to " << edge.b << " of element " << edge.element;
        }
}

/// Messages of the InputError that a call throws, one per line; a failure if it throws none.
template <class Call>
std::string input_error_of(Call&& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError";
    return "";
}

}  // namespace gneiss::testing
