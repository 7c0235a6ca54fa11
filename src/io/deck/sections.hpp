#pragma once
// The tables of a deck. `schema.hpp` says what a section is, `keys.hpp` how its keys are made.

#include <string>
#include <vector>

#include "io/deck/schema.hpp"

namespace gneiss::deck {

const Section<CaseOptions>& case_section();
const Section<MeshOptions>& mesh_section();
const Section<BoundaryPart>& part_section();
const Section<SolidOptions>& solid_section();
const Section<MaterialOptions>& material_section();
const Section<LoadOptions>& load_section();
const Section<BoundaryOptions>& boundary_section();
const Section<LumpedOptions>& lumped_section();
const Section<BurnOptions>& burn_section();
const Section<InitialOptions>& initial_section();
const Section<IntegratorOptions>& integrator_section();
const Section<RunOptions>& run_section();
const Section<OutputOptions>& output_section();
const Section<ProbeOptions>& probe_section();
const Section<AmplitudeOptions>& amplitude_section();

/// Elastic constants as a deck may give them: one set of them, named by the keys that are present.
struct GivenConstants {
    std::optional<double> M_v, M_alpha, M_beta, M_psi;                                   ///< Munjiza, Pa
    std::optional<double> E, nu;                                                         ///< isotropic, Pa
    std::optional<double> E_alpha, E_beta, nu_alpha_beta, nu_beta_alpha, nu_p_alpha, G;  ///< transversely isotropic, Pa
    std::optional<double> mu, lambda;                                                    ///< Lamé, Pa
};
const Section<GivenConstants>& constants_section();
const Section<AxesOptions>& axes_section();
const Section<MaterialOptions::Stiffening>& stiffening_section();
const Section<MaterialOptions>& viscosity_section();
const Section<StrengthOptions>& strength_section();
const Section<FractureOptions>& fracture_section();
const Section<ContactOptions>& contact_section();
const Section<WallOptions>& wall_section();
const Section<CrackOptions>& crack_section();
const Section<InterfaceOptions>& interface_section();
const Section<InnerLine>& line_section();
const Section<CompareOptions>& compare_section();
const Section<SchemeOptions>& scheme_section();
const Section<ExactOptions>& exact_section();

/// Whether exactly one of the sets that suit the law is given, and completely; reports otherwise.
bool check_constants_set(const Value& value, const GivenConstants& given, LawKind law);

/// Turns one complete set of constants under `value` into those of the law; [solid] plane decides how. Reports what is
/// inconsistent or inadmissible.
bool resolve_constants(const Value& value, const GivenConstants& given, MaterialOptions& material);

/// Reads a name that heads columns of a file, "history.csv".
bool read_column_name(const Value& value, std::string& out, std::string_view file);

/// Reads an amplitude: a table, or the bare name of one that needs nothing else.
bool read_amplitude(const Value& value, AmplitudeOptions& out);

/// Reads a table of strengths; reports what is wrong with it.
bool read_strength(const Value& value, StrengthOptions& out);

/// A section for the reference.
struct SectionDoc {
    std::string name;     ///< "material.constants"
    std::string heading;  ///< "`[[material]]` constants = { … }"
    std::vector<std::string>
        paths;  ///< full names under which its keys are found: "load.amplitude", "boundary.amplitude"
    std::vector<KeyDoc> keys;
};
const std::vector<SectionDoc>& section_docs();

}  // namespace gneiss::deck
