#include "app/state_series.hpp"

#include <fmt/format.h>

#include "mesh/geometry.hpp"
#include "mesh/sub_triangles.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

std::string entry(std::size_t sample, const char* what) { return fmt::format("{:06}.{}", sample, what); }

SamplePlaces places_of(const Mesh& mesh) {
    SamplePlaces places;
    const auto n = static_cast<std::size_t>(mesh.nodes_per_element());
    const auto subs = sub_triangles(mesh.kind);
    places.node_area.assign(mesh.connectivity.size(), 0.0);
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        for (std::size_t k = 0; k < n; ++k)
            for (const double x : mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])]) places.node_at.push_back(x);
        for (const SubTriangle& sub : subs) {
            std::array<Point2, 3> corners;
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = mesh.nodes[static_cast<std::size_t>(mesh.element(e)[sub[i]])];
            const double area = std::abs(triangle_area(corners[0], corners[1], corners[2]));
            places.triangle_area.push_back(area);
            for (const int k : sub) places.node_area[n * e + static_cast<std::size_t>(k)] += area / 3;
            for (std::size_t c = 0; c < 2; ++c)
                places.triangle_at.push_back((corners[0][c] + corners[1][c] + corners[2][c]) / 3);
        }
    }
    return places;
}

}  // namespace

StateSeries::StateSeries(std::filesystem::path file, const Mesh& mesh, std::optional<double> restart_time)
    : file_(std::move(file)), mesh_(mesh) {
    if (!restart_time) {
        std::filesystem::remove(file_);
    } else if (std::filesystem::exists(file_)) {
        for (StateSample& sample : read_states(file_).samples)
            if (sample.t <= *restart_time) samples_.push_back(std::move(sample));
    }
}

void StateSeries::add(const SolidSystem& system, const State& state) {
    StateSample sample;
    sample.t = state.t;
    for (const std::int32_t node : mesh_.connectivity)
        for (const std::size_t i : {2 * static_cast<std::size_t>(node), 2 * static_cast<std::size_t>(node) + 1}) {
            sample.displacement.push_back(state.u[i]);
            sample.velocity.push_back(state.v[i]);
        }
    for (const PointFields& point : system.point_fields(state))
        sample.stress.insert(sample.stress.end(), point.cauchy.begin(), point.cauchy.end());
    samples_.push_back(std::move(sample));
}

void StateSeries::save() const {
    Checkpoint file;
    const SamplePlaces places = places_of(mesh_);
    file.set("node_area", places.node_area);
    file.set("triangle_area", places.triangle_area);
    file.set("node_at", places.node_at);
    file.set("triangle_at", places.triangle_at);
    file.set("samples", static_cast<std::int64_t>(samples_.size()));
    for (std::size_t k = 0; k < samples_.size(); ++k) {
        file.set(entry(k, "t"), samples_[k].t);
        file.set(entry(k, "displacement"), samples_[k].displacement);
        file.set(entry(k, "velocity"), samples_[k].velocity);
        file.set(entry(k, "stress"), samples_[k].stress);
    }
    file.save(file_);
}

SavedStates read_states(const std::filesystem::path& file) {
    using Numbers = std::vector<double>;
    const Checkpoint saved = Checkpoint::load(file);
    SavedStates states;
    states.places = {saved.get<Numbers>("node_area"), saved.get<Numbers>("triangle_area"),
                     saved.get<Numbers>("node_at"), saved.get<Numbers>("triangle_at")};
    const std::size_t n_nodal = 2 * states.places.node_area.size(), n_stress = 3 * states.places.triangle_area.size();
    const auto n = static_cast<std::size_t>(saved.get<std::int64_t>("samples"));
    for (std::size_t k = 0; k < n; ++k)
        states.samples.push_back(
            {saved.get<double>(entry(k, "t")), saved.get<Numbers>(entry(k, "displacement"), n_nodal),
             saved.get<Numbers>(entry(k, "velocity"), n_nodal), saved.get<Numbers>(entry(k, "stress"), n_stress)});
    return states;
}

}  // namespace gneiss
