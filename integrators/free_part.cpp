#include "integrators/free_part.hpp"

#include "base/errors.hpp"

namespace gneiss {

const Tangent& tangent_of(const SemiDiscrete& system, const std::string& scheme) {
    if (const Tangent* tangent = system.tangent()) return *tangent;
    throw InputError("integrator", scheme + " needs tangents, and this system has none");
}

std::vector<std::size_t> constrained_dofs(const SemiDiscrete& system) {
    std::vector<std::size_t> dofs;
    for (const Constraint& constraint : system.constraints()) dofs.push_back(constraint.dof);
    return dofs;
}

FreeMatrix free_part(const SemiDiscrete& system, const Tangent& tangent) {
    const MatrixPattern full = tangent.pattern();
    return FreeMatrix({full.row_starts, full.columns}, constrained_dofs(system));
}

}  // namespace gneiss
