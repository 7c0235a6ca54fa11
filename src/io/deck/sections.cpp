#include "io/deck/sections.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "io/deck/keys.hpp"
#include "mesh/mesh_file_kind.hpp"

namespace gneiss::deck {
namespace {

/// Numbers by name, for a .geo.
bool read_parameters(const Value& value, TableReader&, MeshOptions& out) {
    const toml::table* content = value.node().as_table();
    if (content == nullptr) {
        value.refuse("a table of numbers");
        return false;
    }
    bool good = true;
    for (const auto& [name, node] : *content) {
        const Value parameter(value.findings(), node, fmt::format("{}.{}", value.key(), name.str()), value.where());
        good = parameter.read(out.parameters[std::string(name.str())], NumberRule{}) && good;
    }
    return good;
}

bool is_mesh_file(const std::filesystem::path& name) { return mesh_file_kind(name) != MeshFileKind::other; }

/// Why a mesh file cannot be read, and what there is in its place; empty if it is there.
std::string why_missing(const std::filesystem::path& file) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::is_regular_file(file, error)) return {};
    const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
    if (!fs::is_directory(folder, error)) return fmt::format("there is no folder {}", folder.string());
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (is_mesh_file(entry.path())) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    std::string text = fmt::format("no such file in {}", folder.string());
    constexpr std::size_t most_names = 10;
    const std::size_t n = std::min(names.size(), most_names);
    if (n == 0) return text + ", which has no .msh and no .geo";
    text +=
        fmt::format(", which has {}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(n), ", "),
                    n < names.size() ? ", …" : "");
    return text + suggestion(file.filename().string(), {names.begin(), names.end()});
}

bool read_mesh_file(const Value& value, TableReader&, MeshOptions& out) {
    if (!value.read(out.file)) return false;
    out.source = MeshOptions::Source::file;
    if (!is_mesh_file(out.file)) {
        value.refuse("a file of Gmsh, ending in .msh or .geo, or of Abaqus, ending in .inp");
        return false;
    }
    const auto& folder = value.findings().folder;
    const std::string why = folder ? why_missing(*folder / out.file) : "";
    if (!why.empty()) value.problem(fmt::format("given {}: {}", value.given(), why));
    return why.empty();
}

bool read_corners(const Value& value, TableReader&, MeshOptions& out) {
    const auto points = value.elements(out.corners.size(), "points [x, y]");
    bool good = points.has_value();
    for (std::size_t i = 0; points && i < out.corners.size(); ++i)
        good = (*points)[i].read(std::span<double>(out.corners[i]), NumberRule{Range{}, "m"}) && good;
    if (!good) return false;
    const int reflex = reflex_corner(out.corners);
    if (reflex < 0) return true;
    (*points)[static_cast<std::size_t>(reflex)].problem(
        "does not turn left: the quadrilateral must be convex and its corners counter-clockwise, bottom left, bottom "
        "right, top right, top left");
    return false;
}

bool read_cells(const Value& value, TableReader&, MeshOptions& out) {
    const auto values = value.elements(out.cells.size(), "integers ≥ 1");
    bool good = values.has_value();
    for (std::size_t i = 0; values && i < out.cells.size(); ++i) {
        good = (*values)[i].read(out.cells[i], NumberRule{at_least(1), ""}) && good;
    }
    return good;
}

void check_mesh(TableReader& table, MeshOptions& mesh) {
    if (table.given("generator") && table.given("file")) {
        table.problem("file", "given together with `generator`, a mesh comes from one of them");
    }
    const bool plate =
        table.chosen("generator") == "plate_with_hole" && !table.failed("side") && !table.failed("radius");
    if (plate && !(mesh.side > 2 * mesh.radius)) {
        table.problem("side", fmt::format("given {}, must be > {} m, twice the radius", mesh.side, 2 * mesh.radius));
    }
}

void check_solid(TableReader& table, SolidOptions& solid) {
    if (!table.failed("plane")) table.findings().plane = solid.plane;
    if (!table.failed("element") && !table.failed("volumetric")) table.findings().volumetric = solid.volumetric;
}

/// Reports frames that would come after the end of the run.
void check_field_times(const TableReader& table, const CaseOptions& options) {
    const auto& times = options.output.field_times;
    for (std::size_t i = 0; options.run.t_end > 0 && i < times.size(); ++i) {
        if (!(times[i] > options.run.t_end)) continue;
        const toml::node& node = *table.table()["output"]["field_times"][i].node();
        Value(table.findings(), node, fmt::format("output.field_times[{}]", i), table.where())
            .refuse(fmt::format("<= {} s, where the run ends: `run.t_end`", options.run.t_end));
    }
}

void check_output(TableReader& table, OutputOptions& output) {
    for (std::size_t i = 0; i < output.probes.size(); ++i) {
        const std::string& name = output.probes[i].name;
        const auto same = [&](const ProbeOptions& probe) { return probe.name == name; };
        const auto first = std::find_if(output.probes.begin(), output.probes.end(), same) - output.probes.begin();
        if (name.empty() || static_cast<std::size_t>(first) == i) continue;
        const toml::node& node = *table.table()["probes"][i]["name"].node();
        Value(table.findings(), node, fmt::format("{}[{}].name", table.path_of("probes"), i), table.where())
            .problem(
                fmt::format("given \"{}\", which is the name of {}[{}] already", name, table.path_of("probes"), first));
    }
}

/// Tables that mean nothing without the method of another one: left out if --set has switched it off, else a mistake.
template <class T>
void idle_tables(const TableReader& table, std::string_view name, std::vector<T>& out, std::string_view owner,
                 std::string_view why) {
    const std::string message = fmt::format("has no effect without `{}.method`{}", owner, why);
    const toml::node* method = table.table()[owner]["method"].node();
    if (method == nullptr || !position_of(method->source(), table.where()).is_override())
        return table.problem(name, message);
    table.findings().note(position_of(table.table().get(name)->source(), table.where()), name,
                          "left out, it " + message);
    out.clear();
}

/// Reports names that one of [[lumped]] has taken already.
void check_model_names(const TableReader& table, const std::vector<LumpedOptions>& models) {
    std::map<std::string, std::size_t> owner;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const auto [found, is_new] = owner.emplace(models[i].name, i);
        if (is_new || models[i].name.empty()) continue;
        const toml::node& node = *table.table()["lumped"][i]["name"].node();
        Value(table.findings(), node, fmt::format("lumped[{}].name", i), table.where())
            .problem(
                fmt::format("given \"{}\", which is the name of lumped[{}] already", models[i].name, found->second));
    }
}

}  // namespace

bool read_column_name(const Value& value, std::string& out, std::string_view file) {
    if (!value.read(out)) return false;
    if (out.find_first_of(",\"' \t\n") == std::string::npos) return true;
    value.refuse(fmt::format("free of blanks, commas and quotes: it heads columns of {}", file));
    return false;
}

const Section<BoundaryPart>& part_section() {
    using P = BoundaryPart;
    static const Section<P> section{
        {string("name", &P::name, {.required = true, .meaning = "of the part, for loads and boundary conditions"}),
         string("of", &P::of, {.required = true, .meaning = "name of a boundary"}),
         numbers("from", &P::from, {.unit = "m", .required = true, .meaning = "lower left corner of a box, [x, y]"}),
         numbers("to", &P::to,
                 {.unit = "m",
                  .required = true,
                  .meaning = "its upper right corner: edges inside and on its rim are the part"})}};
    return section;
}

const Section<InnerLine>& line_section() {
    using L = InnerLine;
    static const Section<L> section{
        {string("name", &L::name, {.required = true, .meaning = "of the line, for cracks and interfaces"}),
         numbers("from", &L::from, {.unit = "m", .required = true, .meaning = "its one end, [x, y]"}),
         numbers("to", &L::to, {.unit = "m", .required = true, .meaning = "its other end, [x, y]"})}};
    return section;
}

const Section<MeshOptions>& mesh_section() {
    using M = MeshOptions;
    const std::vector<Condition> rectangle{{"generator", {"rectangle"}}},
        quadrilateral{{"generator", {"quadrilateral"}}}, cells{{"generator", {"rectangle", "quadrilateral"}}},
        plate{{"generator", {"plate_with_hole"}}}, file{{"file", {}}},
        plate_or_file{{"generator", {"plate_with_hole"}}, {"file", {}}};
    static const Section<M> section{
        {choice<M>("generator", mesh_generators, "", [](M& out, M::Source source) { out.source = source; },
                   {.required = true, .or_else = "file", .meaning = "shape that is meshed here; or give `file`"}),
         custom<M>(
             "file", "a string", "",
             {.meaning =
                  "mesh of Gmsh, `.msh` (of any version) or `.geo`, or of Abaqus, `.inp`, relative to the deck; or "
                  "give `generator`"},
             read_mesh_file),
         custom<M>("parameters", "a table of numbers", "",
                   {.only_for = file, .meaning = "numbers defined before a `.geo` is read, `{ name = number, … }`"},
                   read_parameters),
         number("width", &M::width,
                {.unit = "m", .range = above(0), .required = true, .only_for = rectangle, .meaning = "extent along x"}),
         number("height", &M::height,
                {.unit = "m", .range = above(0), .required = true, .only_for = rectangle, .meaning = "extent along y"}),
         numbers("origin", &M::origin, {.unit = "m", .only_for = rectangle, .meaning = "lower left corner, [x, y]"}),
         custom<M>("corners", "an array of 4 points", "",
                   {.unit = "m",
                    .required = true,
                    .only_for = quadrilateral,
                    .meaning = "`[[x, y], …]`: bottom left, bottom right, top right, top left; convex"},
                   read_corners),
         custom<M>(
             "cells", "an array of 2 integers", "",
             {.range = at_least(1),
              .required = true,
              .only_for = cells,
              .meaning = "cells along x and y, or along the bottom and the left side; a composite's sub-edges are "
                         "half as long as a cell"},
             read_cells),
         choice("pattern", &M::pattern, mesh_patterns, {.only_for = cells, .meaning = "diagonals of the cells"}),
         number("side", &M::side,
                {.unit = "m",
                 .range = above(0),
                 .required = true,
                 .only_for = plate,
                 .meaning = "side of the square, more than twice the radius"}),
         number("radius", &M::radius,
                {.unit = "m", .range = above(0), .required = true, .only_for = plate, .meaning = "radius of the hole"}),
         numbers(
             "size", &M::size,
             {.unit = "m",
              .range = above(0),
              .required = true,
              .only_for = plate,
              .meaning = "edge of a composite at the hole and at the outer boundary; its sub-edges are half as long"}),
         choice("layout", &M::layout, mesh_layouts, {.only_for = plate, .meaning = "how the plate is meshed"}),
         integer("seed", &M::seed,
                 {.range = at_least(0),
                  .only_for = plate,
                  .meaning = "moves the first point on the hole, so that free meshes differ"}),
         boolean("curved", &M::curved,
                 {.only_for = plate_or_file,
                  .meaning = "mid-side nodes follow a curved boundary; false: all sides straight"}),
         tables("parts", &M::parts, part_section, {.meaning = "parts of boundaries that get a name of their own"}),
         tables("lines", &M::lines, line_section,
                {.meaning = "straight lines of sides inside the solid that get a name"})},
        check_mesh};
    return section;
}

const Section<SolidOptions>& solid_section() {
    using S = SolidOptions;
    static const Section<S> section{
        {choice("element", &S::compt, elements, {.meaning = "kind of element"}),
         choice("plane", &S::plane, planes, {.required = true, .meaning = "what happens out of the plane"}),
         number("thickness", &S::thickness, {.unit = "m", .range = above(0), .meaning = "out of the plane"}),
         choice(
             "volumetric", &S::volumetric, volumetrics,
             {.only_for = {{"element", {"compt"}}}, .meaning = "where a composite takes its one volumetric stretch"})},
        check_solid};
    return section;
}

const Section<RunOptions>& run_section() {
    using R = RunOptions;
    static const Section<R> section{
        {number("t_end", &R::t_end,
                {.unit = "s", .range = above(0), .required = true, .meaning = "simulated time at which the run ends"}),
         number(
             "checkpoint", &R::checkpoint,
             {.unit = "s", .range = at_least(0), .meaning = "simulated time between checkpoints; 0: one at the end"}),
         number("mass_damping", &R::mass_damping,
                {.unit = "1/s", .range = at_least(0), .meaning = "damping force per mass and velocity"}),
         number("event_tolerance", &R::event_tolerance,
                {.unit = "s",
                 .range = at_least(0),
                 .meaning = "steps in which a side reaches its strength, or two bodies touch or part, are taken again, "
                            "shorter, until the instant is known to this; 0: sides open at the end of the step"}),
         number("most_energy_gained", &R::most_energy_gained,
                {.range = {.low = 0, .high = 1, .low_open = false},
                 .meaning = "part of the largest energy in the balance that may have come from nothing; with more the "
                            "run ends as failed, for its scheme is unstable. 0: it goes on. From 0.01 on there is a "
                            "warning, for lost energy too"})}};
    return section;
}

const Section<ProbeOptions>& probe_section() {
    using P = ProbeOptions;
    static const Section<P> section{
        {custom<P>(
             "name", "a string", "",
             {.required = true,
              .meaning = "heads the columns of probes.csv; no two alike, no blanks, commas or quotes"},
             [](const Value& value, TableReader&, P& out) { return read_column_name(value, out.name, "probes.csv"); }),
         numbers("at", &P::at, {.unit = "m", .required = true, .meaning = "position in the reference shape, [x, y]"}),
         numbers("about", &P::about,
                 {.unit = "m", .meaning = "centre, [x, y]: adds the components along and across the ray from it"})}};
    return section;
}

const Section<OutputOptions>& output_section() {
    using O = OutputOptions;
    static const Section<O> section{
        {number("fields", &O::fields,
                {.unit = "s",
                 .range = at_least(0),
                 .meaning = "simulated time between fields for ParaView; 0: the first and the last state only"}),
         numbers("field_times", &O::field_times,
                 {.unit = "s", .range = at_least(0), .meaning = "further times at which the fields are written"}),
         choice("vtu_data", &O::base64, vtu_data, {.meaning = "how the numbers stand in .vtu files"}),
         number("history", &O::history,
                {.unit = "s",
                 .range = at_least(0),
                 .meaning = "simulated time between rows of history.csv, probes.csv and reactions.csv; 0: a thousandth "
                            "of the run, with `rows = \"steps\"`"}),
         choice("rows", &O::rows_at_steps, row_places, {.meaning = "where rows stand whose interval is given"}),
         number("states", &O::states,
                {.unit = "s",
                 .range = at_least(0),
                 .meaning = "simulated time between whole states in full precision, in states.h5; 0: none"}),
         tables("probes", &O::probes, probe_section, {.meaning = "points that are watched"})},
        check_output};
    return section;
}

const Section<CaseOptions>& case_section() {
    using C = CaseOptions;
    const auto check = [](TableReader& table, C& out) {
        if (!out.interfaces.empty() && !table.failed("fracture") && !table.failed("interface") &&
            out.fracture.method == FractureOptions::Method::none)
            idle_tables(table, "interface", out.interfaces, "fracture", ": elements stay together");
        if (table.given("material") && out.materials.empty() && !table.failed("material")) {
            table.problem("material", "given none, must be at least one [[material]]");
        }
        check_model_names(table, out.lumped);
        if (!table.failed("run") && !table.failed("output")) check_field_times(table, out);
        if (!out.walls.empty() && out.contact.method == ContactOptions::Method::none && !table.failed("contact"))
            idle_tables(table, "wall", out.walls, "contact", "");
        for (std::size_t i = 0; i < out.walls.size(); ++i)
            if (out.walls[i].normal == std::array{0.0, 0.0} && !table.failed("wall"))
                table.problem("wall", fmt::format("the normal of wall[{}] has no length", i));
        std::map<std::string, std::size_t> owner;  // of each region; the empty name stands for all others
        for (std::size_t i = 0; i < out.materials.size(); ++i) {
            const toml::node& node = *table.table()["material"][i].node();
            const Value material(table.findings(), node, fmt::format("material[{}].region", i), table.where());
            const auto& regions = out.materials[i].regions;
            for (const std::string& region : regions.empty() ? std::vector<std::string>{""} : regions) {
                const auto [found, is_new] = owner.emplace(region, i);
                if (is_new) continue;
                material.problem(
                    region.empty()
                        ? fmt::format("missing, and material[{}] takes all other regions already", found->second)
                        : fmt::format("\"{}\" is given twice, first to material[{}]", region, found->second));
            }
        }
    };
    static const Section<C> section{
        {string("title", &C::title, {.meaning = "one line about the case"}),
         table("mesh", &C::mesh, mesh_section, {.required = true, .meaning = "the mesh"}),
         table("solid", &C::solid, solid_section, {.required = true, .meaning = "kind of element and plane"}),
         tables("material", &C::materials, material_section,
                {.required = true, .meaning = "materials, one `[[material]]` each"}),
         tables("load", &C::loads, load_section, {.meaning = "loads, one `[[load]]` each"}),
         tables("boundary", &C::boundaries, boundary_section,
                {.meaning = "boundary conditions, one `[[boundary]]` each"}),
         tables("lumped", &C::lumped, lumped_section,
                {.meaning = "gas in cavities, masses and actuators on boundaries, one `[[lumped]]` each"}),
         tables("initial", &C::initial, initial_section, {.meaning = "initial velocities, one `[[initial]]` each"}),
         table("fracture", &C::fracture, fracture_section, {.meaning = "cracks along edges of elements"}),
         table("contact", &C::contact, contact_section, {.meaning = "contact of bodies, and of the faces of cracks"}),
         tables("wall", &C::walls, wall_section, {.meaning = "rigid walls that bodies touch, one `[[wall]]` each"}),
         tables("crack", &C::cracks, crack_section,
                {.meaning = "cracks that are there before the run, one `[[crack]]` each"}),
         tables("interface", &C::interfaces, interface_section,
                {.meaning = "sides with strengths of their own, one `[[interface]]` each"}),
         table("integrator", &C::integrator, integrator_section, {.meaning = "time integration"}),
         table("run", &C::run, run_section, {.required = true, .meaning = "how long, how damped"}),
         table("output", &C::output, output_section, {.meaning = "what is written, and when"}),
         table("compare", &C::compare, compare_section,
               {.meaning = "schemes that `gneiss compare` runs; `gneiss run` makes nothing of it"})},
        check};
    return section;
}

}  // namespace gneiss::deck
