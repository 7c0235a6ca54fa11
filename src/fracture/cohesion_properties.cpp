#include "fracture/cohesion_properties.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace gneiss {
namespace {

class Findings {
public:
    void require_positive(const char* name, double value, const char* unit) {
        if (!(value > 0 && std::isfinite(value)))
            add(fmt::format("{} is {:.6g} {}, must be > 0 {}", name, value, unit, unit));
    }
    void require_not_negative(const char* name, double value) {
        if (!(value >= 0 && std::isfinite(value))) add(fmt::format("{} is {:.6g}, must be >= 0", name, value));
    }
    void add(std::string message) { problems_.push_back({"", std::move(message)}); }
    bool none() const { return problems_.empty(); }
    void throw_if_any() const {
        if (!none()) throw InputError(problems_);
    }

private:
    std::vector<Problem> problems_;
};

Findings ranges(const CohesionProperties<double>& p) {
    Findings findings;
    findings.require_positive("tensile_strength", p.tensile_strength, "Pa");
    findings.require_positive("cohesion", p.cohesion, "Pa");
    findings.require_not_negative("tan_phi_initial", p.tan_phi_initial);
    findings.require_not_negative("tan_phi_residual", p.tan_phi_residual);
    findings.require_positive("fracture_energy_i", p.fracture_energy_i, "J/m2");
    findings.require_positive("fracture_energy_ii", p.fracture_energy_ii, "J/m2");
    findings.require_positive("penalty", p.penalty, "Pa/m");
    return findings;
}

/// The elastic branch up to the strength must hold less than the fracture energy.
/// @param largest_ratio  of strength^2/(k G)
void require_energy(Findings& findings, const char* energy, double given, double strength, double penalty,
                    double largest_ratio) {
    const double least = strength * strength / (largest_ratio * penalty);
    if (!(given > least))
        findings.add(
            fmt::format("{} is {:.6g} J/m2, must be > {:.6g} J/m2, what the elastic branch takes up to {:.6g} "
                        "Pa: raise it or the penalty, or lower the strength",
                        energy, given, least, strength));
}

void validate(const CohesionProperties<double>& p, double largest_ratio) {
    Findings findings = ranges(p);
    // a comparison of energies says nothing where one of its members is out of range
    if (findings.none()) {
        require_energy(findings, "fracture_energy_i", p.fracture_energy_i, p.tensile_strength, p.penalty,
                       largest_ratio);
        require_energy(findings, "fracture_energy_ii", p.fracture_energy_ii, p.cohesion, p.penalty, largest_ratio);
    }
    findings.throw_if_any();
}

}  // namespace

void validate_mixed_mode(const CohesionProperties<double>& properties) {
    constexpr double largest_ratio = 2;  // B < 2
    validate(properties, largest_ratio);
}

void validate_y_code(const CohesionProperties<double>& properties) {
    constexpr double largest_ratio = 0.75;  // 3 G/f > 2 (2 f/k)
    validate(properties, largest_ratio);
}

double cohesion_length(double fracture_energy, double young, double tensile_strength) {
    return fracture_energy * young / (tensile_strength * tensile_strength);
}

}  // namespace gneiss
