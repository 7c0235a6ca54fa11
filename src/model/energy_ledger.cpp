#include "model/energy_ledger.hpp"

#include <algorithm>
#include <cmath>

namespace gneiss {

double EnergyLedger::left_over() const {
    const double dissipated = path.damping + path.viscous + path.absorbing + path.friction + path.fracture +
                              path.contact + path.leaked + path.dampers;
    return kinetic + scheme + stored.sum() + dissipated - initial - path.external_work - path.support_work -
           path.splitting;
}

double EnergyLedger::largest_entry() const {
    double largest = largest_before;
    for (const double entry :
         {kinetic, stored.material, stored.stress_power, stored.contact, stored.joints, stored.models,
          path.external_work, path.support_work, path.damping, path.viscous, path.absorbing, path.friction,
          path.fracture, path.contact, path.leaked, path.dampers, path.splitting, initial})
        largest = std::max(largest, std::abs(entry));
    return largest;
}

double EnergyLedger::relative_left_over() const {
    const double largest = largest_entry();
    return largest > 0 ? left_over() / largest : 0;
}

double EnergyLedger::balance_error() const { return std::abs(relative_left_over()); }

}  // namespace gneiss
