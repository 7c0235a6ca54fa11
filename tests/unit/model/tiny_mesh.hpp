#pragma once
// Meshes small enough to check by hand.

#include "mesh/mesh.hpp"

namespace gneiss::test {

/// Rectangle 2 m x 1 m of two CST, "rock" below the rising diagonal and "clay" above it.
///
///     3-------2       sides "bottom", "right", "top", "left", all of them "outer"; nodes "corner" = {2}
///     |clay / |
///     | / rock|
///     0-------1
inline Mesh rectangle_mesh() {
    Mesh mesh;
    mesh.kind = ElementKind::cst;
    mesh.nodes = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
    mesh.connectivity = {0, 1, 2, 0, 2, 3};
    mesh.region = {0, 1};
    mesh.region_names = {"rock", "clay"};
    mesh.boundaries = {{"bottom", {{0, 1, 0}}},
                       {"right", {{1, 2, 0}}},
                       {"top", {{2, 3, 1}}},
                       {"left", {{3, 0, 1}}},
                       {"outer", {{0, 1, 0}, {1, 2, 0}, {2, 3, 1}, {3, 0, 1}}}};
    mesh.node_sets = {{"bottom", {0, 1}}, {"right", {1, 2}},       {"top", {2, 3}},
                      {"left", {0, 3}},   {"outer", {0, 1, 2, 3}}, {"corner", {2}}};
    mesh.node_labels = {11, 12, 13, 14};
    mesh.element_labels = {1, 2};
    return mesh;
}

/// One composite triangle "rock" with corners (0, 0), (3, 0), (0, 2) m and its mid-side nodes off the middle; its six
/// edges are "outer".
inline Mesh composite_mesh() {
    Mesh mesh;
    mesh.kind = ElementKind::compt;
    mesh.nodes = {{0, 0}, {1.4, -0.1}, {3, 0}, {1.7, 1.1}, {0, 2}, {-0.2, 0.9}};
    mesh.connectivity = {0, 1, 2, 3, 4, 5};
    mesh.region = {0};
    mesh.region_names = {"rock"};
    mesh.boundaries = {{"outer", {{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 5, 0}, {5, 0, 0}}}};
    mesh.node_sets = {{"outer", {0, 1, 2, 3, 4, 5}}};
    mesh.node_labels = {1, 2, 3, 4, 5, 6};
    mesh.element_labels = {1};
    return mesh;
}

}  // namespace gneiss::test
