#pragma once

namespace gneiss::test {

/// Together these decks use every key of the schema.
inline const char* const full_decks[] = {
    R"toml(
title = "plate, transversely isotropic rock, hypo-elastic"
[mesh]
generator = "plate_with_hole"
side = 40.0
radius = 1
size = [0.1, 0.5]
layout = "structured"
seed = 3
curved = false
[solid]
element = "compt"
plane = "strain"
thickness = 2.0
volumetric = "centre"
[[material]]
region = ["rock", "vein"]
law = "munjiza"
form = "hypo"
stress_map = "direct"
density = 2650
constants = { E_alpha = 20e9, E_beta = 10e9, nu_alpha_beta = 0.3, nu_beta_alpha = 0.15, nu_p_alpha = 0.2, G = 4.5e9 }
axes = { angle = "0.2*sin(x/5)" }
stiffening = { k = 1, p_ref = 1e6, n = 0.5 }
in_situ_stress = [-1e6, "-2e6 - 25e3*y", 0]
viscosity = { shear = 10, bulk = 20.0 }
[[material]]
density = 2000.0
constants = { M_v = 0, M_alpha = 1e9, M_beta = 2e9, M_psi = 1e9 }
stress_map = "direct"
strength = { tensile = [1e6, 3e6], cohesion = 5e6, friction = 0.6, residual_friction = 0.4, G_I = [50, 200.0], G_II = 500 }
[fracture]
method = "extrinsic"
criterion = "larger"
overshoot = 0.02
penalty = 30
on = ["rock", "fault"]
weibull_modulus = 12
seed = 3
[contact]
method = "potential"
friction = 0.5
restitution = 0.9
penalty_factor = 2
tangential_factor = 0.8
potential_cap = 3
skin = 0.3
[[wall]]
point = [0, -1]
normal = [0, 1]
velocity = [0.0, 0.1]
friction = 0.2
[[crack]]
on = "fault"
[[interface]]
on = "bedding"
strength = { tensile = 1e6, cohesion = 5e6, friction = 0.6, residual_friction = 0.4, G_I = 50, G_II = 500 }
[[interface]]
between = ["rock", "vein"]
strength = { tensile = 1e6, cohesion = 5e6, friction = 0.6, residual_friction = 0.4, G_I = 50, G_II = 500 }
[[load]]
on = "hole"
type = "pressure"
value = 1e6
amplitude = { type = "ramp", start = 1e-3, end = 2e-3 }
[[load]]
type = "body_force"
value = [0, "-9.81*2650"]
amplitude = { type = "expression", expression = "sin(2*pi*t)*x" }
[[boundary]]
on = "outer"
type = "velocity"
value = ["free", "0.1*x"]
amplitude = { type = "table", times = [0, 1, 1, 2], values = [0, 1, 0, 0] }
[[boundary]]
on = "outer"
type = "displacement"
value = [0, "free"]
amplitude = { type = "heaviside", start = 0.5 }
[[lumped]]
type = "gas"
name = "blast"
on = "hole"
pressure = 1e6
gamma = 1.3
leak = 10
burn = { energy = 1e6, time = 1e-3, exponent = 0.7, reference_pressure = 1e7 }
about = [0, 0]
[[lumped]]
type = "mass"
name = "hammer"
on = "top"
direction = [0, -1]
mass = 100
stiffness = 1e9
damping = 1e5
gap = 1e-3
bonded = false
ground_stiffness = 1e3
velocity = 4
force = 981
[[lumped]]
type = "actuator"
name = "jack"
on = "bottom"
direction = [0, 1]
stiffness = 1e9
displacement = 1e-3
amplitude = { type = "ramp", end = 1e-2 }
[[initial]]
on = "rock"
velocity = [0, "0.1*x"]
[integrator]
type = "central_difference"
safety = 0.5
dt = 1e-6
bound = "lanczos"
[run]
t_end = 0.02
checkpoint = 0.01
mass_damping = 3
event_tolerance = 1e-9
most_energy_gained = 0.1
[output]
fields = 2e-4
field_times = [1e-3, 0.5e-3]
history = 1e-5
rows = "steps"
vtu_data = "base64"
states = 1e-3
probes = [{ at = [5.0, 0.0], name = "p0", about = [0.0, 0.0] }]
[compare]
samples = 7
exact = { displacement = ["x*t", 0], velocity = ["x", 0], stress = [1e6, 0, 0] }
[[compare.scheme]]
name = "leapfrog"
integrator = { type = "central_difference", safety = [0.8, 0.4] }
)toml",
    R"toml(
[mesh]
generator = "rectangle"
width = 2
height = 1
origin = [-1, -0.5]
cells = [4, 2]
pattern = "crossed"
parts = [{ name = "half", of = "top", from = [0, 0.5], to = [1, 0.5] }]
lines = [{ name = "notch", from = [-1, 0], to = [0, 0] }]
[solid]
plane = "stress"
[[material]]
law = "neo_hookean"
density = 1000
constants = { mu = 1e9, lambda = 2e9 }
[integrator]
type = "quasi_static"
tolerance = 1e-8
step = 0.1
longest = 0.2
shortest = 1e-4
most_iterations = 10
solver = "gmres"
preconditioner = "diagonal"
linear_tolerance = 1e-6
most_linear_iterations = 500
matrix_free = true
[run]
t_end = 1
[compare]
reference = { type = "cvode", rtol = 1e-10 }
[[compare.scheme]]
name = "one"
integrator = { type = "newmark", dt = 1e-3 }
)toml",
    R"toml(
mesh = { generator = "quadrilateral", corners = [[0, 0], [48, 44], [48, 60], [0, 44]], cells = [2, 3] }
solid = { plane = "strain" }
material = [{ density = 1000, constants = { E = 1e9, nu = 0.25 } }]
contact = { method = "potential", friction = 0, penalty = 1e10 }
run = { t_end = 1 }
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "generalized_alpha"
rho_inf = 0.5
interface_tolerance = 1e-3
adaptive = true
rtol = 1e-5
displacement_scale = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "newmark"
beta = 0.3
gamma = 0.6
dt = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "hht_alpha"
alpha = 0.2
dt = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "cvode"
velocity_scale = 1
stress_scale = 1e6
method = "adams"
iteration = "functional"
max_order = 4
stability_detection = true
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "arkode"
table = "sdirk_2_1_2"
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
levels = 4
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "verlet"
form = "position"
composition = "suzuki_5"
safety = 0.9
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "noh_bathe"
split = 0.6
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "bathe"
rho_inf = 0
dt = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "mri"
slow_table = "mri_gark_erk45a"
dt = 1e-5
rtol = 1e-5
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.geo"
parameters = { lc = 0.1, n = 3 }
[solid]
element = "cst"
plane = "stress"
[[material]]
region = "a"
density = 1000
constants = { E = 1e9, nu = 0.25 }
axes = { bedding = [[[0, 0], [1, 0.1], [2, 0]], [[0, 1], [2, 1]]] }
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.5 }
axes = { data = "theta" }
[run]
t_end = 1
)toml"};

}  // namespace gneiss::test
