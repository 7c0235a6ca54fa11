#include "fracture/crack_criterion.hpp"

#include "fracture/nodal_criterion.hpp"
#include "fracture/side_criterion.hpp"

namespace gneiss {

WatchReach watch_reach(FractureOptions::Criterion criterion) {
    // At a tip the force on a node, over the little area that the interfaces there represent, is larger than any
    // stress: half a ring of elements pulls at two interfaces, or at one beside an open crack.
    if (criterion == FractureOptions::Criterion::nodal) return {true, 3};
    return {};
}

std::unique_ptr<CrackCriterion> make_crack_criterion(FractureOptions::Criterion criterion,
                                                     CrackCriterion::Parts parts) {
    switch (criterion) {
        case FractureOptions::Criterion::mean:
            return std::make_unique<SideCriterion>(parts, SideCriterion::Of::mean);
        case FractureOptions::Criterion::larger:
            return std::make_unique<SideCriterion>(parts, SideCriterion::Of::larger);
        case FractureOptions::Criterion::nodal:
            break;
    }
    return std::make_unique<NodalCriterion>(parts);
}

}  // namespace gneiss
