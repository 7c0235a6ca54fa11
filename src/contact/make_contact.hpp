#pragma once
// From what a user says about contact to the interaction.

#include <memory>
#include <span>

#include "contact/contact.hpp"
#include "contact/contact_bodies.hpp"
#include "model/element_block.hpp"
#include "model/options.hpp"

namespace gneiss {

/// @param blocks  of the mesh
/// @throws InputError if an option is out of its range, or bodies overlap in the reference shape: ten pairs by name, of
/// the others the number
std::unique_ptr<Contact> make_contact(const PartedMesh& start, std::span<const std::unique_ptr<ElementBlock>> blocks,
                                      const SolidOptions& solid, const ContactOptions& contact, bool comes_apart);

}  // namespace gneiss
