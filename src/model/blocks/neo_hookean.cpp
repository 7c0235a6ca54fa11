#include "materials/neo_hookean.hpp"

#include "model/blocks/instantiate.hpp"

namespace gneiss {

std::unique_ptr<ElementBlock> make_neo_hookean_block(const Mesh& mesh, BlockGeometry geometry,
                                                     const SolidOptions& solid, const MaterialOptions& material) {
    if (solid.plane == Plane::stress)
        return make_triangle_block(mesh, std::move(geometry), solid,
                                   NeoHookean<true>{material.shear_modulus, material.lame_lambda});
    return make_triangle_block(mesh, std::move(geometry), solid,
                               NeoHookean<false>{material.shear_modulus, material.lame_lambda});
}

}  // namespace gneiss
