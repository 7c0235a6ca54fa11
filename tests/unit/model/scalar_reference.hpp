#pragma once
// Forces, memory and energies of a mesh assembled element by element with the double kernels, in the plainest way: what
// the packs, blocks and chunks are compared with.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "elements/triangle_kernel.hpp"
#include "materials/munjiza_hyperelastic.hpp"
#include "materials/munjiza_hypoelastic.hpp"
#include "materials/neo_hookean.hpp"
#include "mesh/mesh.hpp"
#include "model/options.hpp"

namespace gneiss::test {

class ScalarElement {
public:
    virtual ~ScalarElement() = default;
    /// From the accepted memory to the forces at u, v; with `accept` the memory becomes that at u.
    virtual void add_force(const std::vector<double>& u, const std::vector<double>& v, bool accept,
                           std::vector<double>& f) = 0;
    virtual double stored_energy(const std::vector<double>& u) const = 0;
    virtual double stress_power() const = 0;
    virtual double viscous_power(const std::vector<double>& u, const std::vector<double>& v) const = 0;
    /// z of all sub-triangles, one after the other.
    virtual std::vector<double> internal() const = 0;
};

template <class Element, class Law>
class ScalarTriangle final : public ScalarElement {
public:
    ScalarTriangle(const Mesh& mesh, std::size_t e, double angle, double thickness, const ViscousStress& viscosity,
                   Law law, Sampling sampling)
        : nodes_(mesh.element(e)), viscosity_(viscosity), law_(law), sampling_(sampling) {
        std::array<Vec2<double>, Element::n_nodes> x;
        for (int i = 0; i < Element::n_nodes; ++i) {
            const auto& at = mesh.nodes[static_cast<std::size_t>(nodes_[i])];
            x[i] = {at[0], at[1]};
        }
        geometry_ = triangle_geometry<Element>(x, {std::cos(angle), std::sin(angle)}, thickness);
        for (auto& memory : memory_) memory = {};
    }

    void add_force(const std::vector<double>& u, const std::vector<double>& v, bool accept,
                   std::vector<double>& f) override {
        const auto kinematics = kinematics_at(u);
        const auto stress = triangle_stress<Element, false>(law_, kinematics, geometry_, memory_);
        std::array<Vec2<double>, Element::n_nodes> own;
        triangle_force(kinematics, geometry_, stress, own);
        if (viscosity_.active())
            add_viscous_force<Element>(viscosity_, kinematics, rates(kinematics, v), geometry_, own);
        for (int i = 0; i < Element::n_nodes; ++i) {
            f[2 * static_cast<std::size_t>(nodes_[i])] += own[i].x;
            f[2 * static_cast<std::size_t>(nodes_[i]) + 1] += own[i].y;
        }
        if (!accept) return;
        for (int s = 0; s < Element::n_sub; ++s)
            memory_[s] = law_.update(kinematics.point[s], stress.volume, stress.point[s], stress.q, memory_[s]);
    }
    double stored_energy(const std::vector<double>& u) const override {
        double sum = 0;
        if constexpr (Law::has_stored_energy) {
            const auto kinematics = kinematics_at(u);
            for (int s = 0; s < Element::n_sub; ++s)
                sum += geometry_.of(s).volume *
                       law_.energy_density(kinematics.point[s], law_.volume(kinematics.volume_strain));
        }
        return sum;
    }
    double stress_power() const override {
        double sum = 0;
        if constexpr (!Law::has_stored_energy)
            for (int s = 0; s < Element::n_sub; ++s) sum += geometry_.of(s).volume * memory_[s].z[Law::n_internal - 1];
        return sum;
    }
    double viscous_power(const std::vector<double>& u, const std::vector<double>& v) const override {
        const auto kinematics = kinematics_at(u);
        std::array<Vec2<double>, Element::n_nodes> own{};
        return add_viscous_force<Element>(viscosity_, kinematics, rates(kinematics, v), geometry_, own);
    }
    std::vector<double> internal() const override {
        std::vector<double> all;
        for (const auto& memory : memory_) all.insert(all.end(), memory.z.begin(), memory.z.end());
        return all;
    }

private:
    std::array<Vec2<double>, Element::n_nodes> pairs(const std::vector<double>& values) const {
        std::array<Vec2<double>, Element::n_nodes> own;
        for (int i = 0; i < Element::n_nodes; ++i) {
            const std::size_t x = 2 * static_cast<std::size_t>(nodes_[i]);
            own[i] = {values[x], values[x + 1]};
        }
        return own;
    }
    TriangleKinematics<Element, double> kinematics_at(const std::vector<double>& u) const {
        return triangle_kinematics<Element>(pairs(u), geometry_, sampling_);
    }
    auto rates(const TriangleKinematics<Element, double>& kinematics, const std::vector<double>& v) const {
        return triangle_rates<Element>(pairs(v), kinematics, geometry_, sampling_);
    }

    const std::int32_t* nodes_;
    ViscousStress viscosity_;
    Law law_;
    Sampling sampling_;
    TriangleGeometry<Element, double> geometry_;
    std::array<typename Law::template Memory<double>, Element::n_sub> memory_;
};

template <class Law>
std::unique_ptr<ScalarElement> scalar_triangle(const Mesh& mesh, std::size_t e, double angle, const SolidOptions& solid,
                                               const ViscousStress& viscosity, Law law) {
    if (mesh.kind == ElementKind::cst)
        return std::make_unique<ScalarTriangle<Cst, Law>>(mesh, e, angle, solid.thickness, viscosity, law,
                                                          Sampling::mean);
    const bool centre = solid.volumetric == Volumetric::centre;
    return std::make_unique<ScalarTriangle<CompositeTriangle, Law>>(mesh, e, angle, solid.thickness, viscosity, law,
                                                                    centre ? Sampling::centre : Sampling::mean);
}

/// One element of a material as its options describe it.
inline std::unique_ptr<ScalarElement> scalar_element(const Mesh& mesh, std::size_t e, double angle,
                                                     const SolidOptions& solid, const MaterialOptions& material) {
    const ViscousStress viscosity{material.shear_viscosity, material.bulk_viscosity};
    const auto make = [&](auto law) { return scalar_triangle(mesh, e, angle, solid, viscosity, law); };
    const bool direct = material.stress_map == StressMap::direct;
    if (material.law == LawKind::neo_hookean) {
        if (solid.plane == Plane::stress) return make(NeoHookean<true>{material.shear_modulus, material.lame_lambda});
        return make(NeoHookean<false>{material.shear_modulus, material.lame_lambda});
    }
    const Stiffening stiffening{material.stiffening.k, material.stiffening.p_ref, material.stiffening.n};
    if (material.form == Form::hyper)
        return direct ? make(MunjizaHyperelastic<true>{material.constants})
                      : make(MunjizaHyperelastic<false>{material.constants});
    return direct ? make(MunjizaHypoelastic<true>{material.constants, stiffening})
                  : make(MunjizaHypoelastic<false>{material.constants, stiffening});
}

}  // namespace gneiss::test
