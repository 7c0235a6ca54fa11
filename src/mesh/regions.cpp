#include "mesh/regions.hpp"

#include <algorithm>
#include <string_view>

namespace gneiss {
namespace {

constexpr std::string_view conjunction = " & ";

std::vector<std::string> groups_in(std::string_view name) {
    std::vector<std::string> groups;
    while (true) {
        const std::size_t at = name.find(conjunction);
        groups.emplace_back(name.substr(0, at));
        if (at == std::string_view::npos) return groups;
        name.remove_prefix(at + conjunction.size());
    }
}

}  // namespace

std::string name_of_overlap(std::vector<std::string> groups) {
    std::ranges::sort(groups);
    std::string name = groups.front();
    for (std::size_t i = 1; i < groups.size(); ++i) name.append(conjunction).append(groups[i]);
    return name;
}

std::vector<std::string> names_of_regions(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const auto& groups : groups_of_regions(mesh))
        for (const std::string& group : groups)
            if (std::ranges::find(names, group) == names.end()) names.push_back(group);
    return names;
}

std::vector<std::int32_t> regions_named(const Mesh& mesh, const std::string& name) {
    std::vector<std::int32_t> regions;
    for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
        if (mesh.region_names[r] == name || std::ranges::count(groups_in(mesh.region_names[r]), name) > 0)
            regions.push_back(static_cast<std::int32_t>(r));
    return regions;
}

std::vector<std::vector<std::string>> groups_of_regions(const Mesh& mesh) {
    std::vector<std::vector<std::string>> groups;
    for (const std::string& name : mesh.region_names) groups.push_back(groups_in(name));
    return groups;
}

}  // namespace gneiss
