#pragma once
// A case in which all that the program knows of forces and supports acts together.

#include "support/small_solids.hpp"

namespace gneiss::test {

/// A block under everything there is: pressure that follows, traction, damping, viscosity, absorbing and moving sides.
inline SolidDescription everything(Form form) {
    SolidDescription what;
    what.materials[0].form = form;
    what.materials[0].shear_viscosity = 2e3;
    if (form == Form::hypo) what.materials[0].stiffening = {1, 1e7, 0.5};
    what.mass_damping = 50;
    LoadOptions pressure;
    pressure.kind = LoadOptions::Kind::pressure;
    pressure.on = "top";
    pressure.value[0] = 5e6;
    pressure.amplitude.kind = AmplitudeOptions::Kind::heaviside;
    LoadOptions weight;
    weight.kind = LoadOptions::Kind::body_force;
    weight.value = {0, -9810};
    LoadOptions late = pressure;
    late.kind = LoadOptions::Kind::traction;
    late.on = "top";
    late.value = {2e6, 0};
    late.amplitude.start = 7.3e-4;
    what.loads = {pressure, weight, late};
    BoundaryOptions absorbing, moving;
    absorbing.kind = BoundaryOptions::Kind::absorbing;
    absorbing.on = "left";
    moving.on = "bottom";
    moving.value = {Formula(0.0), Formula(1e-3)};
    moving.amplitude.kind = AmplitudeOptions::Kind::ramp;
    moving.amplitude.end = 1e-3;
    BoundaryOptions pushing;
    pushing.kind = BoundaryOptions::Kind::velocity;
    pushing.on = "top_right";
    pushing.value[0] = Formula("-2*y");
    pushing.amplitude.kind = AmplitudeOptions::Kind::expression;
    pushing.amplitude.expression = "1 - cos(3000*t)";
    what.boundaries = {absorbing, moving, pushing};
    return what;
}

}  // namespace gneiss::test
