#pragma once
// From materials and a mesh to element blocks.

#include <memory>
#include <vector>

#include "model/element_block.hpp"
#include "model/options.hpp"

namespace gneiss {

/// One block per material that has elements.
/// @throws InputError with every problem: regions that do not exist, elements without a material or with two, faulty
///         axes or stress in situ, volumetric `centre` with a law that is not `direct`
std::vector<std::unique_ptr<ElementBlock>> make_blocks(const Mesh& mesh, const SolidOptions& solid,
                                                       const std::vector<MaterialOptions>& materials);

}  // namespace gneiss
