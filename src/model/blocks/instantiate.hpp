#pragma once
// The choice of element and sampling for a given law. Included only by the files that instantiate.

#include "model/blocks/make_block.hpp"
#include "model/triangle_block.hpp"

namespace gneiss {

template <class Element, class Law>
std::unique_ptr<ElementBlock> make_composite_block(const Mesh& mesh, BlockGeometry geometry, const SolidOptions& solid,
                                                   Law law) {
    if constexpr (Law::offers_centre) {
        if (solid.volumetric == Volumetric::centre)
            return std::make_unique<TriangleBlock<Element, Sampling::centre, Law>>(mesh, std::move(geometry), law);
    }
    return std::make_unique<TriangleBlock<Element, Sampling::mean, Law>>(mesh, std::move(geometry), law);
}

/// @param geometry  of CST, or of composites that are all straight, or else of any composites
template <class Law>
std::unique_ptr<ElementBlock> make_triangle_block(const Mesh& mesh, BlockGeometry geometry, const SolidOptions& solid,
                                                  Law law) {
    if (mesh.kind == ElementKind::cst)
        return std::make_unique<TriangleBlock<Cst, Sampling::mean, Law>>(mesh, std::move(geometry), law);
    if (geometry.straight)
        return make_composite_block<StraightCompositeTriangle>(mesh, std::move(geometry), solid, law);
    return make_composite_block<CompositeTriangle>(mesh, std::move(geometry), solid, law);
}

}  // namespace gneiss
