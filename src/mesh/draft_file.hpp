#pragma once
// A draft, or what is wrong with it, on its way from one process to another on the same machine.

#include <filesystem>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "mesh/draft.hpp"

namespace gneiss {

using DraftOrProblems = std::variant<MeshDraft, std::vector<Problem>>;

/// @throws std::runtime_error if the file cannot be written
void write_draft(const std::filesystem::path& file, const DraftOrProblems& result);

/// What write_draft() wrote, bit by bit.
/// @throws std::runtime_error if the file is not whole
DraftOrProblems read_draft(const std::filesystem::path& file);

}  // namespace gneiss
