#include "report.hpp"

namespace gneiss::crosscheck {

const char* name_of(Element element) {
    switch (element) {
        case Element::p1:
            return "p1";
        case Element::p2:
            return "p2";
        case Element::taylor_hood:
            break;
    }
    return "taylor_hood";
}

nlohmann::ordered_json report(const ElasticCase& what, const Solution& solution) {
    nlohmann::ordered_json json;
    json["deal_ii"] = deal_ii_version();
    json["element"] = name_of(what.problem.element);
    json["composites_are_cells"] = what.composites_are_cells;
    json["n_cells"] = what.problem.n_cells();
    json["n_unknowns"] = solution.n_unknowns;
    json["iterations"] = solution.iterations;
    json["residual"] = solution.residual;
    json["assembly_seconds"] = solution.assembly_seconds;
    json["solve_seconds"] = solution.solve_seconds;
    json["compliance"] = solution.compliance;
    json["strain_energy"] = solution.strain_energy;
    auto& probes = json["probes"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < what.probe_names.size(); ++i) probes[what.probe_names[i]] = solution.displacement_at[i];
    auto& displacement = json["displacement"] = nlohmann::ordered_json::array();
    for (std::size_t node = 0; node < what.nodes.size(); ++node) displacement.push_back(solution.displacement[node]);
    auto &cauchy = json["cauchy"] = nlohmann::ordered_json::array(),
         &pressure = json["pressure"] = nlohmann::ordered_json::array();
    for (const PointStress& stress : solution.stress_at) {
        cauchy.push_back(stress.cauchy);
        pressure.push_back(stress.pressure);
    }
    return json;
}

}  // namespace gneiss::crosscheck
