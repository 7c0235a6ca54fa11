#pragma once
// Amplitudes in one line each.

#include <string>
#include <utility>
#include <vector>

#include "model/options.hpp"

namespace gneiss::test {

inline AmplitudeOptions heaviside(double start) {
    AmplitudeOptions options;
    options.kind = AmplitudeOptions::Kind::heaviside;
    options.start = start;
    return options;
}

inline AmplitudeOptions ramp(double start, double end) {
    AmplitudeOptions options;
    options.kind = AmplitudeOptions::Kind::ramp;
    options.start = start;
    options.end = end;
    return options;
}

inline AmplitudeOptions table(std::vector<double> times, std::vector<double> values) {
    AmplitudeOptions options;
    options.kind = AmplitudeOptions::Kind::table;
    options.times = std::move(times);
    options.values = std::move(values);
    return options;
}

inline AmplitudeOptions expression(const std::string& text) {
    AmplitudeOptions options;
    options.kind = AmplitudeOptions::Kind::expression;
    options.expression = text;
    return options;
}

}  // namespace gneiss::test
