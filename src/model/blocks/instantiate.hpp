#pragma once
// The choice of element for a given law. Included only by the files that instantiate.

#include "model/blocks/make_block.hpp"
#include "model/triangle_block.hpp"

namespace gneiss {

/// @param geometry  of CST, or of composites that are all straight, or else of any composites
template <class Law>
std::unique_ptr<ElementBlock> make_triangle_block(const Mesh& mesh, BlockGeometry geometry, const SolidOptions& solid,
                                                  Law law) {
    if (mesh.kind == ElementKind::cst)
        return std::make_unique<TriangleBlock<Cst, Law>>(mesh, std::move(geometry), law, Sampling::mean);
    const Sampling sampling =
        Law::offers_centre && solid.volumetric == Volumetric::centre ? Sampling::centre : Sampling::mean;
    if (geometry.straight)
        return std::make_unique<TriangleBlock<StraightCompositeTriangle, Law>>(mesh, std::move(geometry), law,
                                                                               sampling);
    return std::make_unique<TriangleBlock<CompositeTriangle, Law>>(mesh, std::move(geometry), law, sampling);
}

}  // namespace gneiss
