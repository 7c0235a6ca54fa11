#include "app/field_frames.hpp"

#include <cmath>

#include "mesh/composite.hpp"

namespace gneiss {
namespace {

/// The triangles of a mesh as .vtu files have them.
struct FieldTriangles {
    explicit FieldTriangles(const Mesh& mesh);
    FieldMesh on(const Mesh& mesh) const {
        return {mesh.nodes, triangles, {{"element", elements}, {"region", regions}}};
    }

    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::int32_t> elements, regions;
};

FieldTriangles::FieldTriangles(const Mesh& mesh) {
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        const std::int32_t* nodes = mesh.element(e);
        const auto add = [&](const SubTriangle& triangle) {
            triangles.push_back({nodes[triangle[0]], nodes[triangle[1]], nodes[triangle[2]]});
            elements.push_back(static_cast<std::int32_t>(e));
            regions.push_back(mesh.region[e]);
        };
        if (mesh.kind == ElementKind::cst)
            add({0, 1, 2});
        else
            for (const SubTriangle& sub : composite_sub_triangles) add(counter_clockwise(sub));
    }
}

}  // namespace

FieldFrames::FieldFrames(const std::filesystem::path& folder, const Mesh& mesh, std::optional<double> restart_time,
                         VtuData data)
    : mesh_(mesh),
      n_nodes_(mesh.n_nodes()),
      series_(folder, FieldTriangles(mesh).on(mesh), restart_time, "fields", data) {}

void FieldFrames::write(const SolidSystem& system, const State& state, std::size_t step) {
    if (mesh_.n_nodes() != n_nodes_) series_.set_mesh(FieldTriangles(mesh_).on(mesh_));
    n_nodes_ = mesh_.n_nodes();
    const std::vector<PointFields> points = system.point_fields(state);
    // of the mesh: points of lumped models stand behind
    const std::vector<double> u(state.u.begin(), state.u.begin() + static_cast<std::ptrdiff_t>(2 * n_nodes_));
    const std::vector<double> v(state.v.begin(), state.v.begin() + static_cast<std::ptrdiff_t>(2 * n_nodes_));
    std::vector<double> speed(n_nodes_), cauchy, munjiza, stretch, alpha, beta;
    for (std::size_t i = 0; i < speed.size(); ++i) speed[i] = std::hypot(v[2 * i], v[2 * i + 1]);
    for (const PointFields& point : points) {
        const auto& [xx, yy, xy] = point.cauchy;
        cauchy.insert(cauchy.end(), {xx, yy, point.cauchy_zz, xy, 0, 0});
        munjiza.insert(munjiza.end(), point.munjiza.begin(), point.munjiza.end());
        stretch.insert(stretch.end(), point.stretch.begin(), point.stretch.end());
        alpha.insert(alpha.end(), point.alpha.begin(), point.alpha.end());
        beta.insert(beta.end(), point.beta.begin(), point.beta.end());
    }
    // VTK's order of a symmetric tensor, by which ParaView's filters know von Mises' and principal stresses
    const std::vector<std::string> tensor{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    const std::vector<std::string> components{"v", "alpha", "beta", "psi"};
    series_.write(state.t, static_cast<std::int64_t>(step),
                  {{{"displacement", u, "m", 2}, {"velocity", v, "m/s", 2}, {"speed", speed, "m/s"}},
                   {{"cauchy_stress", cauchy, "Pa", 6, tensor},
                    {"munjiza_stress", munjiza, "Pa", 4, components},
                    {"stretch", stretch, "", 4, components},
                    {"axis_alpha", alpha, "", 2},
                    {"axis_beta", beta, "", 2}}});
}

}  // namespace gneiss
