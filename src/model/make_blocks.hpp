#pragma once
// From materials and a mesh to element blocks.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/element_block.hpp"
#include "model/impedance.hpp"
#include "model/options.hpp"

namespace gneiss {

/// One block per material that has elements.
/// @throws InputError with every problem: regions that do not exist, elements without a material or with two, faulty
///         axes or stress in situ, volumetric `centre` with a law that is not `direct`
std::vector<std::unique_ptr<ElementBlock>> make_blocks(const Mesh& mesh, const SolidOptions& solid,
                                                       const std::vector<MaterialOptions>& materials);

/// Number of the material of each element.
/// @throws InputError as make_blocks() for regions
std::vector<std::int32_t> material_of_elements(const Mesh& mesh, const std::vector<MaterialOptions>& materials);

/// Of each element at the start, by its number: what small waves feel.
std::vector<PlaneStiffness> element_stiffness(const Mesh& mesh, std::span<const std::unique_ptr<ElementBlock>> blocks);

}  // namespace gneiss
