#pragma once
// What the cross-check says: README.md explains every key.

#include <nlohmann/json.hpp>

#include "case.hpp"

namespace gneiss::crosscheck {

/// "p1", "p2", "taylor_hood"
const char* name_of(Element element);

nlohmann::ordered_json report(const ElasticCase& what, const Solution& solution);

}  // namespace gneiss::crosscheck
