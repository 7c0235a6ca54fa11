#include "model/make_lumped.hpp"

#include <fmt/format.h>

#include "model/gas_cavity.hpp"
#include "model/mesh_names.hpp"
#include "model/platen.hpp"
#include "model/problem_list.hpp"

namespace gneiss {

std::vector<std::unique_ptr<LumpedModel>> make_lumped(const Mesh& mesh, const std::vector<LumpedOptions>& options,
                                                      double thickness, const Courses& courses) {
    ProblemList problems;
    std::vector<std::unique_ptr<LumpedModel>> models;
    for (std::size_t i = 0; i < options.size(); ++i)
        problems.attempt(fmt::format("[[lumped]] {}", i + 1), [&] {
            const auto& edges = boundary_named(mesh, options[i].on);
            if (options[i].kind == LumpedOptions::Kind::gas)
                models.push_back(std::make_unique<GasCavity>(options[i], mesh, edges, thickness));
            else
                models.push_back(std::make_unique<Platen>(options[i], mesh, edges, course_at(courses, i)));
        });
    problems.throw_if_any();
    return models;
}

}  // namespace gneiss
