#pragma once
// What a user describes, as plain values: the deck is read into these structs, a program that uses the library fills
// them by hand. No behaviour here beyond validation of ranges. SI units, angles in radians.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/scheme_defaults.hpp"
#include "materials/elastic_constants.hpp"
#include "mesh/mesh_options.hpp"

namespace gneiss {

/// A number, or an expression that muParser evaluates. Which variables it may use is stated at each member.
struct Formula {
    std::string text = "0";                ///< the expression; of a plain number its shortest exact decimal form
    std::optional<double> constant = 0.0;  ///< set when the user gave a plain number

    Formula() = default;
    Formula(double value);  // NOLINT: numbers convert on purpose
    Formula(std::string expression) : text(std::move(expression)), constant(std::nullopt) {}
    bool is_zero() const { return constant && *constant == 0.0; }
};

enum class Plane { stress, strain };
enum class Volumetric { mean, centre };      ///< where COMPT takes its volumetric stretch, FORMULATION 2
enum class StressMap { conjugate, direct };  ///< FORMULATION 3
enum class LawKind { munjiza, neo_hookean };
enum class Form { hyper, hypo };

// ---- solid and materials --------------------------------------------------------------------------------------------

struct SolidOptions {
    bool compt = true;  ///< false: CST on the same nodes
    Plane plane = Plane::strain;
    double thickness = 1;  ///< m, > 0
    Volumetric volumetric = Volumetric::mean;
};

/// Direction of the material axis alpha in the reference shape; beta is alpha turned by +90 degrees.
struct AxesOptions {
    enum class Kind { angle, bedding, data };
    Kind kind = Kind::angle;
    Formula angle;                                            ///< rad from x; may use x, y (m): element centroid
    std::vector<std::vector<std::array<double, 2>>> bedding;  ///< polylines, m, at least 2 points each
    std::string data;  ///< name of per-element data of the mesh file: angle in rad
};

/// Of edges that lie along the material axis alpha, and across it; in between by the sine squared  [FORMULATION 7].
using DirectionalOption = std::array<double, 2>;

/// What holds edges together that may crack.
struct StrengthOptions {
    DirectionalOption tensile{0, 0}, cohesion{0, 0};                      ///< Pa, > 0
    DirectionalOption friction{0, 0}, residual_friction{0, 0};            ///< tangents of angles, >= 0
    DirectionalOption fracture_energy_i{0, 0}, fracture_energy_ii{0, 0};  ///< J/m2, > 0
};

struct MaterialOptions {
    std::vector<std::string> regions;  ///< empty: every region that no other material names
    LawKind law = LawKind::munjiza;
    Form form = Form::hyper;
    StressMap stress_map = StressMap::conjugate;
    double density = 0;  ///< kg/m3, > 0, no default in a deck

    /// Munjiza constants; engineering constants have been turned into them by (15)-(18).
    MunjizaConstants constants;
    double across = 0;                          ///< M_z of transversely_isotropic_across(), Pa, in plane strain
    double shear_modulus = 0, lame_lambda = 0;  ///< neo-Hookean, Pa, three-dimensional constants

    AxesOptions axes;

    /// Stiffening under confinement, hypo only: M = M0 (1 + k <p>/p_ref)^n  [FORMULATION 4].
    struct Stiffening {
        double k = 0, p_ref = 1, n = 0;
    } stiffening;                           ///< k >= 0, p_ref > 0 Pa, n in [0, 1]
    std::array<Formula, 3> in_situ_stress;  ///< Cauchy xx, yy, xy, Pa, tension positive; may use x, y; hypo only
    double shear_viscosity = 0, bulk_viscosity = 0;  ///< Pa s, >= 0
    std::optional<StrengthOptions> strength;         ///< needed where edges may crack
};

// ---- fracture -------------------------------------------------------------------------------------------------------

struct FractureOptions {
    enum class Method {
        none,
        extrinsic,  ///< sides open where they reach their strength
        intrinsic,  ///< joints on every edge from the start, mixed-mode law
        y_code      ///< the same with Y-code's law
    };
    Method method = Method::none;
    /// When sides open (extrinsic).
    enum class Criterion {
        nodal,   ///< where no tractions inside the envelope hold the elements around a node together
        mean,    ///< where the mean of the tractions of the two elements reaches the envelope
        larger,  ///< where the larger one of them does
    };
    Criterion criterion = Criterion::nodal;
    double overshoot = 0;  ///< how far tractions may be beyond the strength where sides open, -, >= 0; 0: 0.01, or
                           ///< what a step brings under explicit schemes that the mesh limits
    double penalty = 20;   ///< stiffness of joints: this times the P-wave modulus over the edge's length, > 0
    double weibull_modulus = 0;  ///< scatter of strengths from edge to edge, > 0; 0: none
    int seed = 0;                ///< of the scatter, >= 0
    /// Names of regions and of lines inside the solid: sides within these regions, on these lines and of interfaces may
    /// crack, all others stay bonded and need no strength. Not given: all sides may.
    std::optional<std::vector<std::string>> on = {};
};

/// A line of sides that is open from the start.
struct CrackOptions {
    std::string on;  ///< name of a line inside the solid
};

/// Sides with strengths of their own.
struct InterfaceOptions {
    std::string on;                    ///< name of a line inside the solid; or
    std::vector<std::string> between;  ///< two regions or more: the sides where any two of them meet
    bool between_any = false;          ///< the same of all regions
    StrengthOptions strength;          ///< in place of the materials'; directions are those of their axes
};

// ---- contact --------------------------------------------------------------------------------------------------------

struct ContactOptions {
    enum class Method {
        none,      ///< bodies pass through each other
        potential  ///< FORMULATION 6
    };
    Method method = Method::none;
    double friction = 0;           ///< Coulomb's mu, >= 0, no default in a deck
    double restitution = 1;        ///< e: e^2 of the energy of an impact comes back, in (0, 1]
    double penalty = 0;            ///< Pa/m, > 0; 0: from penalty_factor
    double penalty_factor = 1;     ///< times the stiffness of a layer of elements on either side, in series, > 0
    double tangential_factor = 1;  ///< tangential stiffness over the normal one, > 0
    double potential_cap = 4;      ///< in local sizes: no penetration potential is larger, > 0
    double skin = 0.2;             ///< in shortest edges of the boundary: see CellSearch, > 0
};

/// A rigid half-plane that bodies rest on or are pressed by.
struct WallOptions {
    std::array<double, 2> point{0, 0};     ///< on its face at t = 0, m
    std::array<double, 2> normal{0, 1};    ///< out of the wall, towards the bodies; any length > 0
    std::array<double, 2> velocity{0, 0};  ///< m/s
    std::optional<double> friction;        ///< >= 0; unset: that of contact
};

// ---- loads, boundaries, initial state -------------------------------------------------------------------------------

/// Factor on a load or a prescribed motion against time.
struct AmplitudeOptions {
    enum class Kind { constant, heaviside, ramp, table, expression };
    Kind kind = Kind::constant;
    double start = 0;                   ///< heaviside: switched on here, s; ramp: leaves 0 here
    double end = 0;                     ///< ramp: reaches 1 here, s, > start
    std::vector<double> times, values;  ///< table: times ascending, s, two equal times make a jump; held outside
    std::string expression;             ///< may use t (s), x, y (m)
};

struct LoadOptions {
    enum class Kind { nodal_force, traction, pressure, body_force };
    Kind kind = Kind::traction;
    std::string on;                ///< name of nodes, of a boundary, or of a region; empty for body_force: all
    std::array<Formula, 2> value;  ///< nodal force N, traction Pa, body force N/m3: x and y components;
                                   ///< pressure: the first, Pa, > 0 pushes onto the solid. May use x, y.
    AmplitudeOptions amplitude;
};

struct BoundaryOptions {
    enum class Kind { displacement, velocity, absorbing };
    Kind kind = Kind::displacement;               ///< `fixed` in a deck is displacement 0 in both components
    std::string on;                               ///< name of a boundary or of nodes; absorbing: of a boundary
    std::array<std::optional<Formula>, 2> value;  ///< m or m/s; unset: this component is free. May use x, y.
    AmplitudeOptions amplitude;
};

/// A charge that burns by Vieille's law: a part (p/p_ref)^exponent/time of what is left of it per unit of time.
struct BurnOptions {
    double energy = 0;              ///< J, > 0
    double time = 0;                ///< s, > 0
    double exponent = 0;            ///< >= 0
    double reference_pressure = 0;  ///< Pa, > 0 where there is an exponent
};

/// A model of a few numbers that is coupled to a boundary.
struct LumpedOptions {
    enum class Kind {
        gas,      ///< in a cavity: GasCavity
        mass,     ///< a platen that moves along its direction: Platen
        actuator  ///< a platen that is moved
    };
    Kind kind = Kind::gas;
    std::string name;  ///< heads its columns, no two alike
    std::string on;    ///< name of a boundary

    // gas
    double pressure = 0;                         ///< at t = 0, Pa, > 0
    double gamma = 1.4;                          ///< exponent of its adiabatic, > 1
    double leak = 0;                             ///< part of its mass that is lost per second, 1/s, >= 0
    std::optional<BurnOptions> burn;             ///< a charge in it
    std::optional<std::array<double, 2>> about;  ///< where planes of symmetry that close the boundary meet, m

    // mass, actuator
    std::array<double, 2> direction{0, 0};  ///< in which it pushes; any length > 0
    double stiffness = 0;                   ///< between platen and boundary, N/m, > 0
    double gap = 0;                         ///< before they touch, m, >= 0
    bool bonded = false;                    ///< pulls as well as it pushes
    AmplitudeOptions amplitude;             ///< on `force` or `displacement`; may not depend on x, y

    // mass
    double mass = 0;              ///< kg, > 0
    double damping = 0;           ///< beside the stiffness, N s/m, >= 0
    double ground_stiffness = 0;  ///< spring that holds the mass where it starts, N/m, >= 0
    double velocity = 0;          ///< at t = 0, m/s, along the direction
    double force = 0;             ///< on the mass, N, along the direction

    // actuator
    double displacement = 0;  ///< m, along the direction
};

struct InitialOptions {
    std::string on;                   ///< region or nodes; empty: everything
    std::array<Formula, 2> velocity;  ///< m/s; may use x, y
};

// ---- time, run, output ----------------------------------------------------------------------------------------------

struct IntegratorOptions {
    std::string type = "central_difference";
    double safety = scheme_defaults::safety;  ///< factor on the critical step, (0, 1]
    bool lanczos = false;  ///< bound by a Lanczos estimate of the assembled pencil instead of the elements
    double dt = 0;         ///< fixed step, s; 0: from the critical step, or from the error
    int levels = 1;        ///< central_difference: most lengths of local steps, >= 1

    // verlet, noh_bathe: Verlet::Options, NohBathe::Options
    bool position_form = false;
    std::string composition = scheme_defaults::composition;
    double split = scheme_defaults::split;

    // generalized_alpha, newmark, hht_alpha: GeneralizedAlpha::Options; bathe, Bathe::Options, has rho_inf too
    double rho_inf = scheme_defaults::rho_inf, beta = scheme_defaults::beta, gamma = scheme_defaults::gamma,
           alpha = scheme_defaults::alpha;
    bool adaptive = false;                                              ///< to rtol
    double interface_tolerance = scheme_defaults::interface_tolerance;  ///< of these and bathe

    // cvode, arkode, mri, ida: Cvode::Options, Arkode::Options, Mri::Options, Ida::Options
    bool adams = false, functional = false, stability_detection = scheme_defaults::stability_detection;
    std::string table = scheme_defaults::table, slow_table = scheme_defaults::slow_table;
    int max_order = 0;
    double rtol = scheme_defaults::rtol, displacement_scale = 0, velocity_scale = 0, stress_scale = 0;

    // quasi_static, dynamic_relaxation: LoadStepping::Options
    double tolerance = scheme_defaults::tolerance, step = 0, longest = 0, shortest = scheme_defaults::shortest;
    int most_iterations = 0;  ///< 0: the scheme's own, scheme_defaults::newton_iterations or relaxation_iterations

    // those that solve linear systems: LinearSolverOptions
    std::string solver = scheme_defaults::solver, preconditioner = scheme_defaults::preconditioner;
    double linear_tolerance = scheme_defaults::linear_tolerance;
    int most_linear_iterations = scheme_defaults::linear_iterations;
    bool matrix_free = false;  ///< quasi_static
};

struct RunOptions {
    double t_end = 0;            ///< s, > 0
    double checkpoint = 0;       ///< interval of simulated time between checkpoints, s; 0: only at the end
    double mass_damping = 0;     ///< C = c M, 1/s, >= 0
    double event_tolerance = 0;  ///< how well instants are known at which sides open or bodies meet, s; 0: to a step
    /// Part of the largest energy of the run that may come from nothing before the run ends, [0, 1); 0: it never does.
    double most_energy_gained = 0.5;
};

struct ProbeOptions {
    std::string name;
    std::array<double, 2> at{0, 0};              ///< reference position, m
    std::optional<std::array<double, 2>> about;  ///< centre for radial components, m
};

struct OutputOptions {
    double fields = 0;                ///< interval, s; 0: the first and the last state only
    std::vector<double> field_times;  ///< further times, s, at which the fields are written
    double history = 0;               ///< interval of rows, s; 0: a thousandth of the run, where steps end
    bool rows_at_steps = false;       ///< at the first step that reaches a multiple of it, not at the multiple
    bool base64 = false;              ///< numbers of .vtu files as text
    double states = 0;                ///< interval of whole states in full precision, s; 0: none
    std::vector<ProbeOptions> probes;
};

// ---- comparing schemes ----------------------------------------------------------------------------------------------

/// A scheme with one of its settings.
struct SchemeVariant {
    std::string setting;  ///< what is varied: "dt = 1e-05"; empty: nothing is
    std::string toml;     ///< the whole table as TOML: { type = "cvode", rtol = 1e-06 }
    IntegratorOptions integrator;
};

struct SchemeOptions {
    std::string name;
    std::vector<SchemeVariant> variants;
};

/// A solution in closed form; may use x, y, t.
struct ExactOptions {
    std::array<Formula, 2> displacement;           ///< m
    std::array<Formula, 2> velocity;               ///< m/s
    std::optional<std::array<Formula, 3>> stress;  ///< Cauchy's, xx, yy, xy, Pa
};

/// The same case under several schemes.
struct CompareOptions {
    int samples = 20;  ///< states that are compared, equally far apart in time, >= 1
    std::vector<SchemeOptions> schemes;
    std::optional<SchemeVariant> reference;
    std::optional<ExactOptions> exact;  ///< in place of a reference
};

/// A whole case.
struct CaseOptions {
    std::string title;
    MeshOptions mesh;
    SolidOptions solid;
    std::vector<MaterialOptions> materials;
    std::vector<LoadOptions> loads;
    std::vector<BoundaryOptions> boundaries;
    std::vector<LumpedOptions> lumped;
    std::vector<InitialOptions> initial;
    FractureOptions fracture;
    ContactOptions contact;
    std::vector<WallOptions> walls;
    std::vector<CrackOptions> cracks;
    std::vector<InterfaceOptions> interfaces;
    IntegratorOptions integrator;
    RunOptions run;
    OutputOptions output;
    std::optional<CompareOptions> compare;
};

}  // namespace gneiss
