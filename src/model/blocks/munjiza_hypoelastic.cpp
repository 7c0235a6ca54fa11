#include "materials/munjiza_hypoelastic.hpp"

#include "model/blocks/instantiate.hpp"

namespace gneiss {

std::unique_ptr<ElementBlock> make_munjiza_hypoelastic_block(const Mesh& mesh, BlockGeometry geometry,
                                                             const SolidOptions& solid,
                                                             const MaterialOptions& material) {
    const Stiffening stiffening{material.stiffening.k, material.stiffening.p_ref, material.stiffening.n};
    return make_triangle_block(mesh, std::move(geometry), solid,
                               MunjizaHypoelastic<false>{material.constants, stiffening, material.across});
}

}  // namespace gneiss
