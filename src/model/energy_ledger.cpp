#include "model/energy_ledger.hpp"

#include <algorithm>
#include <cmath>

namespace gneiss {

double EnergyLedger::left_over() const {
    const double dissipated = path.damping + path.viscous + path.absorbing + path.friction + path.fracture +
                              path.contact + path.leaked + path.dampers;
    return kinetic + stored.sum() + dissipated - initial - path.external_work - path.support_work - path.splitting;
}

double EnergyLedger::balance_error() const {
    double largest = 0;
    for (const double entry :
         {kinetic, stored.material, stored.stress_power, stored.contact, stored.joints, stored.models,
          path.external_work, path.support_work, path.damping, path.viscous, path.absorbing, path.friction,
          path.fracture, path.contact, path.leaked, path.dampers, path.splitting, initial})
        largest = std::max(largest, std::abs(entry));
    return largest > 0 ? std::abs(left_over()) / largest : 0;
}

}  // namespace gneiss
