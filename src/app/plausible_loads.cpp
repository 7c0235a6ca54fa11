#include "app/plausible_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.hpp"
#include "io/deck/choices.hpp"
#include "model/amplitude.hpp"
#include "model/mesh_names.hpp"

namespace gneiss {
namespace {

constexpr std::size_t n_instants = 400;  ///< at which an amplitude is looked at over the run
constexpr std::size_t most_points = 100;

/// Instants of the run, those at which tables have their points among them, ascending.
std::vector<double> instants_of(const Amplitude& amplitude, double t_end) {
    std::vector<double> times;
    for (std::size_t i = 0; i <= n_instants; ++i)
        times.push_back(t_end * static_cast<double>(i) / static_cast<double>(n_instants));
    for (const double t : amplitude.switch_times())
        if (t > 0 && t < t_end) times.push_back(t);
    std::ranges::sort(times);
    return times;
}

/// Largest magnitude of an amplitude at a point.
double peak_of(const Amplitude& amplitude, std::span<const double> times, double x, double y) {
    double peak = 0;
    for (const double t : times) peak = std::max(peak, std::abs(amplitude.value(t, t, x, y)));
    return peak;
}

/// The time in which an amplitude rises, or half a period of it: the shortest one between two of its turning points.
double shortest_time_of(const AmplitudeOptions& options, const Amplitude& amplitude, std::span<const double> times,
                        double x, double y) {
    using Kind = AmplitudeOptions::Kind;
    if (options.kind == Kind::ramp) return options.end - options.start;
    if (options.kind == Kind::table) {
        double shortest = 0;
        for (std::size_t i = 1; i < options.times.size(); ++i) {
            const double length = options.times[i] - options.times[i - 1];
            if (options.values[i] != options.values[i - 1] && length > 0)
                shortest = shortest > 0 ? std::min(shortest, length) : length;
        }
        return shortest;
    }
    if (options.kind != Kind::expression) return 0;
    double begins = times.front(), shortest = 0, before = 0;  // of the piece that rises or falls
    bool is_whole = false;                                    // whether it began at a turning point
    double first = 0;
    for (std::size_t i = 1; i < times.size(); ++i) {
        const double change =
            amplitude.value(times[i], times[i], x, y) - amplitude.value(times[i - 1], times[i - 1], x, y);
        if (change * before < 0) {
            const double length = times[i - 1] - begins;
            if (!is_whole)
                first = length;
            else
                shortest = shortest > 0 ? std::min(shortest, length) : length;
            is_whole = true;
            begins = times[i - 1];
        }
        if (change != 0 && before == 0) begins = times[i - 1];
        if (change != 0) before = change;
    }
    return shortest > 0 ? shortest : first;
}

/// Some of many points.
std::vector<std::int32_t> thinned(std::vector<std::int32_t> nodes) {
    const std::size_t every = 1 + nodes.size() / most_points;
    std::vector<std::int32_t> some;
    for (std::size_t i = 0; i < nodes.size(); i += every) some.push_back(nodes[i]);
    return some;
}

/// @param on  a region, or nodes; empty: everything
std::vector<std::int32_t> nodes_of(const Mesh& mesh, const std::string& on, bool may_be_region) {
    if (!on.empty()) return may_be_region ? region_or_nodes_named(mesh, on) : nodes_named(mesh, on);
    std::vector<std::int32_t> all(mesh.n_nodes());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

LoadPeak peak_of(const Case& built, std::size_t number, std::span<const double> modulus, double extent,
                 double shortest_edge) {
    using Kind = LoadOptions::Kind;
    const LoadOptions& load = built.options.loads[number];
    const Amplitude amplitude(load.amplitude);
    const std::vector<double> times = instants_of(amplitude, built.options.run.t_end);
    const CompiledFormula x_part(load.value[0], "xy"), y_part(load.value[1], "xy");
    LoadPeak peak;
    peak.name = fmt::format("[[load]] {}, {}{}", number + 1, deck::name_of(deck::loads, load.kind),
                            load.on.empty() ? "" : fmt::format(" on \"{}\"", load.on));
    const char* unit = load.kind == Kind::nodal_force ? "N" : load.kind == Kind::body_force ? "N/m3" : "Pa";
    const double to_stress = load.kind == Kind::body_force    ? extent
                             : load.kind == Kind::nodal_force ? 1 / (built.options.solid.thickness * shortest_edge)
                                                              : 1;
    for (const std::int32_t node : thinned(nodes_of(*built.mesh, load.on, load.kind == Kind::body_force))) {
        const auto [x, y] = built.mesh->nodes[static_cast<std::size_t>(node)];
        const double value = std::hypot(x_part(x, y), load.kind == Kind::pressure ? 0.0 : y_part(x, y)) *
                             peak_of(amplitude, times, x, y);
        const double m = modulus[static_cast<std::size_t>(node)], stress = value * to_stress;
        if (!(stress / m > peak.over_modulus)) continue;
        peak.value = fmt::format("{:.4g} {}", value, unit);
        peak.stress = stress;
        peak.over_modulus = stress / m;
        peak.modulus = m;
        peak.x = x;
        peak.y = y;
    }
    peak.shortest_time = shortest_time_of(load.amplitude, amplitude, times, peak.x, peak.y);
    return peak;
}

}  // namespace

std::vector<LoadPeak> load_peaks(const Case& built, std::span<const double> modulus, double extent,
                                 double shortest_edge) {
    std::vector<LoadPeak> peaks;
    for (std::size_t i = 0; i < built.options.loads.size(); ++i) try {
            peaks.push_back(peak_of(built, i, modulus, extent, shortest_edge));
        } catch (const InputError&) {
            // an expression without a value at some instant: the run that gets there says so
        }
    for (const LumpedOptions& model : built.options.lumped) {
        if (model.kind != LumpedOptions::Kind::gas) continue;
        const auto& nodes = nodes_named(*built.mesh, model.on);
        const double m = modulus[static_cast<std::size_t>(nodes.front())];
        const auto [x, y] = built.mesh->nodes[static_cast<std::size_t>(nodes.front())];
        peaks.push_back({fmt::format("[[lumped]] `{}`, gas in \"{}\"", model.name, model.on),
                         fmt::format("{:.4g} Pa", model.pressure), model.pressure, model.pressure / m, m, x, y, 0});
    }
    return peaks;
}

double largest_prescribed_speed(const Case& built) {
    double largest = 0;
    const auto take = [&](const std::array<Formula, 2>& value, const AmplitudeOptions* options, const std::string& on) {
        const CompiledFormula x_part(value[0], "xy"), y_part(value[1], "xy");
        const Amplitude amplitude(options != nullptr ? *options : AmplitudeOptions{});
        const std::vector<double> times = instants_of(amplitude, built.options.run.t_end);
        for (const std::int32_t node : thinned(nodes_of(*built.mesh, on, options == nullptr))) {
            const auto [x, y] = built.mesh->nodes[static_cast<std::size_t>(node)];
            largest = std::max(largest, std::hypot(x_part(x, y), y_part(x, y)) * peak_of(amplitude, times, x, y));
        }
    };
    try {
        for (const InitialOptions& initial : built.options.initial) take(initial.velocity, nullptr, initial.on);
        for (const BoundaryOptions& boundary : built.options.boundaries)
            if (boundary.kind == BoundaryOptions::Kind::velocity)
                take({boundary.value[0].value_or(Formula()), boundary.value[1].value_or(Formula())},
                     &boundary.amplitude, boundary.on);
    } catch (const InputError&) {
        // an expression without a value at some instant: the run that gets there says so
    }
    return largest;
}

}  // namespace gneiss
