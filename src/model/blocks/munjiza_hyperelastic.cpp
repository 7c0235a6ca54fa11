#include "materials/munjiza_hyperelastic.hpp"

#include "model/blocks/instantiate.hpp"

namespace gneiss {

std::unique_ptr<ElementBlock> make_munjiza_hyperelastic_block(const Mesh& mesh, BlockGeometry geometry,
                                                              const SolidOptions& solid,
                                                              const MaterialOptions& material) {
    return make_triangle_block(mesh, std::move(geometry), solid,
                               MunjizaHyperelastic<false>{material.constants, material.across});
}

}  // namespace gneiss
