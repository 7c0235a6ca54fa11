#pragma once
// One function per law, each instantiated in a file of its own: the templates are what takes long to compile.

#include <memory>

#include "materials/elastic_constants.hpp"
#include "model/element_block.hpp"
#include "model/options.hpp"

namespace gneiss {

std::unique_ptr<ElementBlock> make_munjiza_hyperelastic_block(const Mesh&, BlockGeometry, const SolidOptions&,
                                                              const MaterialOptions&);
std::unique_ptr<ElementBlock> make_munjiza_hyperelastic_direct_block(const Mesh&, BlockGeometry, const SolidOptions&,
                                                                     const MaterialOptions&);
std::unique_ptr<ElementBlock> make_munjiza_hypoelastic_block(const Mesh&, BlockGeometry, const SolidOptions&,
                                                             const MaterialOptions&);
std::unique_ptr<ElementBlock> make_munjiza_hypoelastic_direct_block(const Mesh&, BlockGeometry, const SolidOptions&,
                                                                    const MaterialOptions&);
std::unique_ptr<ElementBlock> make_neo_hookean_block(const Mesh&, BlockGeometry, const SolidOptions&,
                                                     const MaterialOptions&);

}  // namespace gneiss
