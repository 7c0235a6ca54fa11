#include "app/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "base/errors.hpp"
#include "io/deck/choices.hpp"
#include "io/output/checkpoint.hpp"
#include "io/output/fingerprint.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using Vector = std::vector<double>;
using Integers = std::vector<std::int64_t>;

/// What has joints, faces and pairs, as the deck says it.
std::string interactions_of(const CaseOptions& options) {
    std::string text = fmt::format("fracture.method = \"{}\", contact.method = \"{}\"",
                                   deck::name_of(deck::fracture_methods, options.fracture.method),
                                   deck::name_of(deck::contact_methods, options.contact.method));
    if (!options.walls.empty()) text += fmt::format(", {} [[wall]]", options.walls.size());
    for (const CrackOptions& crack : options.cracks) text += fmt::format(", a [[crack]] on \"{}\"", crack.on);
    return text;
}

/// Names that the mesh has for nodes whose motion is given in `held` and not in `other`: "12 components on `left`".
std::string only_in(const Integers& held, const Integers& other, const Mesh& mesh) {
    Integers only;
    std::ranges::set_difference(held, other, std::back_inserter(only));
    if (only.empty()) return {};
    std::string text = fmt::format("{} component{}", only.size(), only.size() == 1 ? "" : "s");
    const std::pair<const std::string, std::vector<std::int32_t>>* least = nullptr;  // set that has all of them
    for (const auto& set : mesh.node_sets)
        if ((least == nullptr || set.second.size() < least->second.size()) &&
            std::ranges::all_of(only, [&set](std::int64_t dof) {
                return std::ranges::binary_search(set.second, static_cast<std::int32_t>(dof / 2));
            }))
            least = &set;
    if (least != nullptr) return text + fmt::format(" on `{}`", least->first);
    const auto& first = mesh.nodes[static_cast<std::size_t>(only.front() / 2)];
    return text +
           fmt::format(", among them {} at ({:.6g}, {:.6g}) m", only.front() % 2 == 0 ? "x" : "y", first[0], first[1]);
}

/// @throws InputError where the deck has other supports or other interactions than the run that wrote the checkpoint
void need_same_case(const std::string& path, const Checkpoint& checkpoint, const Case& built) {
    if (!checkpoint.contains("held")) return;  // written by a program before this one
    std::vector<Problem> problems;
    const auto& held = checkpoint.get<Integers>("held");
    if (held != built.held) {
        const std::string more = only_in(built.held, held, *built.mesh), less = only_in(held, built.held, *built.mesh);
        problems.push_back(
            {path,
             fmt::format("was written under other supports: {}{}{}. A restart goes on with the same supports; give "
                         "them another `value` or `amplitude`, or hold from the start what has to be held later",
                         more.empty() ? "" : "the deck holds " + more + " more",
                         more.empty() || less.empty() ? "" : ", and ",
                         less.empty() ? "" : "the deck no longer holds " + less)});
    }
    const std::string before = checkpoint.get<std::string>("interactions"), now = interactions_of(built.options);
    if (before != now)
        problems.push_back(
            {path,
             fmt::format("was written with {}, the deck has {}: joints and contact do not come or go at a restart",
                         before, now)});
    if (!problems.empty()) throw InputError(problems);
}

}  // namespace

std::string layout_fingerprint(const Mesh& mesh, const SolidSystem& system) {
    const auto bytes = [](const auto& values) {
        return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
    };
    std::vector<std::uint64_t> blocks{pack_width};
    for (const auto& block : system.elements().blocks())
        blocks.insert(blocks.end(), {block->n_elements(), block->n_internal(), block->n_history()});
    std::uint64_t sum = fingerprint(bytes(mesh.connectivity), fingerprint(bytes(mesh.nodes)));
    sum = fingerprint(bytes(blocks), fingerprint(bytes(mesh.region), sum));
    for (std::size_t i = 0; i < system.models().size(); ++i) {
        const LumpedModel& model = system.models()[i];
        const std::vector<std::uint64_t> unknowns{model.n_internal(), model.point() ? 1U : 0U};
        sum = fingerprint(bytes(unknowns), fingerprint(model.name(), sum));
    }
    return fmt::format("{:016x}", sum);
}

void save_checkpoint(const std::filesystem::path& path, const std::string& deck_fingerprint, const Case& built,
                     const State& state, const RunProgress& progress) {
    Checkpoint checkpoint(deck_fingerprint);
    checkpoint.set("layout", built.layout);
    checkpoint.set("held", built.held);
    checkpoint.set("interactions", interactions_of(built.options));
    checkpoint.set("step", static_cast<std::int64_t>(progress.step));
    checkpoint.set("initial_energy", progress.initial_energy);
    const BalanceRecord& balance = progress.balance;
    checkpoint.set("balance", Vector{balance.largest_entry, balance.most_gained, balance.most_lost,
                                     balance.doubtful_since, balance.gaining_since});
    if (built.cracking != nullptr) checkpoint.set("cracks", built.cracking->save());
    if (built.touches != nullptr) checkpoint.set("touches", built.touches->save());
    checkpoint.set("state.t", state.t);
    checkpoint.set("state.last_event", state.last_event);
    checkpoint.set("state.u", state.u);
    checkpoint.set("state.v", state.v);
    checkpoint.set("state.z", state.z);
    checkpoint.set("state.history", state.history);
    PathEnergies energies = state.path;
    Vector values;
    for (const double* member : energies.members()) values.push_back(*member);
    checkpoint.set("state.path", values);
    checkpoint.set("integrator", built.integrator->name());
    for (const auto& [name, memory] : built.integrator->save()) checkpoint.set("integrator." + name, memory);
    checkpoint.save(path);
}

std::string load_checkpoint(const std::filesystem::path& path, const Case& built, State& state, RunProgress& progress) {
    const Checkpoint checkpoint = Checkpoint::load(path);
    if (checkpoint.get<std::string>("layout") != built.layout)
        throw InputError(
            path.string(),
            "was written for another mesh or other laws than the deck gives, or by a program built for other packs");
    if (checkpoint.get<std::string>("integrator") != built.integrator->name())
        throw InputError(
            path.string(),
            fmt::format("was written by integrator `{}`, the deck has `{}`: a restart goes on under the same scheme",
                        checkpoint.get<std::string>("integrator"), built.integrator->name()));
    need_same_case(path.string(), checkpoint, built);
    if (built.cracking != nullptr) built.cracking->replay(checkpoint.get<Vector>("cracks"));
    if (built.touches != nullptr && checkpoint.contains("touches"))
        built.touches->load(checkpoint.get<Vector>("touches"));
    const Layout layout = built.system->layout();
    progress.step = static_cast<std::size_t>(checkpoint.get<std::int64_t>("step"));
    progress.initial_energy = checkpoint.get<double>("initial_energy");
    const Vector& balance = checkpoint.get<Vector>("balance", 5);
    progress.balance = {balance[0], balance[1], balance[2], balance[3], balance[4]};
    state.t = checkpoint.get<double>("state.t");
    state.last_event = checkpoint.get<double>("state.last_event");
    state.u = checkpoint.get<Vector>("state.u", layout.n_dof);
    state.v = checkpoint.get<Vector>("state.v", layout.n_dof);
    state.z = checkpoint.get<Vector>("state.z", layout.n_internal);
    state.history = checkpoint.get<Vector>("state.history", layout.n_history);
    const auto targets = state.path.members();
    const Vector& values = checkpoint.get<Vector>("state.path", targets.size());
    for (std::size_t k = 0; k < targets.size(); ++k) *targets[k] = values[k];
    apply_due_events(*built.system, state);  // all have happened, but what they found is not saved
    renew_events(*built.system, state);

    IntegratorMemory memory;
    constexpr std::string_view prefix = "integrator.";
    for (const std::string& name : checkpoint.names())
        if (name.starts_with(prefix)) memory[name.substr(prefix.size())] = checkpoint.get<Vector>(name);
    built.integrator->load(*built.system, state, memory);
    return checkpoint.deck_fingerprint();
}

}  // namespace gneiss
