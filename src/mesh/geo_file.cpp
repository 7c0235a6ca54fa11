#include "mesh/geo_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "mesh/crossed_lines.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// A .geo that is gone when the reader is.
class TemporaryFile {
public:
    TemporaryFile(const fs::path& folder, const std::string& text) {
        std::string name = (folder / "gneiss-XXXXXX.geo").string();
        constexpr int suffix_length = 4;
        const int descriptor = mkstemps(name.data(), suffix_length);
        if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "temporary file " + name);
        close(descriptor);
        path_ = name;
        std::ofstream(path_) << text;
    }
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path() const { return path_.string(); }

private:
    fs::path path_;
};

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string(), "cannot be opened for reading");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// A script as Gmsh takes it: the text with // and /* */ comments blanked out, and what strings hold as well.
struct Script {
    std::string with_strings, statements;

    explicit Script(const std::string& text) : with_strings(text), statements(text) {
        for (std::size_t at = 0; (at = text.find_first_of("/\"'", at)) != std::string::npos;) {
            const auto past = [&](std::string_view what, std::size_t from) {
                const std::size_t found = text.find(what, from);
                return found == std::string::npos ? text.size() : found + what.size();
            };
            const auto blank = [&](std::string& in, std::size_t begin, std::size_t end) {
                std::fill(in.begin() + static_cast<long>(begin), in.begin() + static_cast<long>(end), ' ');
            };
            const bool is_string = text[at] != '/', is_line = text.compare(at, 2, "//") == 0;
            std::size_t end = at + 1;
            if (is_string)
                end = past(std::string_view(text).substr(at, 1), at + 1);
            else if (is_line)
                end = std::min(text.find('\n', at), text.size());
            else if (text.compare(at, 2, "/*") == 0)
                end = past("*/", at + 2);
            if (end > at + 1) blank(statements, at, end);
            if (end > at + 1 && !is_string) blank(with_strings, at, end);
            at = end;
        }
    }
};

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_name(const std::string& text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::all_of(text.begin(), text.end(), is_name_character);
}

bool has_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool starts = at == 0 || !is_name_character(text[at - 1]);
        if (starts && (end == text.size() || !is_name_character(text[end]))) return true;
    }
    return false;
}

/// Whether a script finds other files, or names of files, by where it lies itself.
bool knows_its_folder(const std::string& geo) {
    return std::ranges::any_of(std::array{"Include", "Merge", "CurrentDirectory", "CurrentDir", "CurrentFileName",
                                          "FileName", "ShapeFromFile"},
                               [&](const char* word) { return has_word(geo, word); });
}

bool ends_within_a_line(const std::string& text) { return !text.empty() && text.back() != '\n'; }

/// Files that a script includes by a plain name.
std::vector<fs::path> included(const fs::path& file, const std::string& geo) {
    std::vector<fs::path> files;
    constexpr std::string_view word = "Include";
    for (std::size_t at = geo.find(word); at != std::string::npos; at = geo.find(word, at + 1)) {
        const std::size_t open = geo.find_first_not_of(" \t", at + word.size());
        if (open == std::string::npos || geo[open] != '"') continue;
        const std::size_t close = geo.find('"', open + 1);
        if (close == std::string::npos) continue;
        const fs::path other = file.parent_path() / geo.substr(open + 1, close - open - 1);
        if (fs::is_regular_file(other)) files.push_back(other);
    }
    return files;
}

/// What would go wrong unseen: Exit ends the process that Gmsh is at work in, parameters that nobody asks for are taken
/// in silence, and Gmsh skips the last line of an included file where no line break ends it.
void check_geo(const fs::path& file, const Script& geo, const std::map<std::string, double>& parameters) {
    const bool reads_others =
        has_word(geo.statements, "Include") || has_word(geo.statements, "Merge");  // a parameter may be used there
    std::vector<Problem> problems;
    if (has_word(geo.statements, "Exit"))
        problems.push_back({file.string(),
                            "the statement Exit would end Gmsh before the mesh is taken over: use Abort, "
                            "or take it out"});
    for (const fs::path& other : included(file, geo.with_strings))
        if (ends_within_a_line(text_of(other)))
            problems.push_back({other.string(),
                                "the last line does not end in a line break: Gmsh would skip it where the file is "
                                "included"});
    for (const auto& [name, value] : parameters) {
        if (!is_name(name))
            problems.push_back({file.string(), fmt::format("parameter \"{}\" is not a name that Gmsh can read", name)});
        else if (!reads_others && !has_word(geo.with_strings, name))
            problems.push_back({file.string(), fmt::format("parameter \"{}\" does not occur in the file", name)});
    }
    if (!problems.empty()) throw InputError(problems);
}

/// The file as Gmsh reads all of it: itself, or a copy whose last line ends in a line break.
std::unique_ptr<TemporaryFile> mended(const fs::path& file, const std::string& text, const Script& geo) {
    if (!ends_within_a_line(text)) return nullptr;
    const fs::path folder =
        knows_its_folder(geo.statements) ? fs::absolute(file).parent_path() : fs::temp_directory_path();
    try {
        return std::make_unique<TemporaryFile>(folder, text + '\n');
    } catch (const std::system_error& error) {
        throw InputError(file.string(), fmt::format("the last line does not end in a line break, Gmsh would skip it; a "
                                                    "copy that does cannot be made: {}",
                                                    error.what()));
    }
}

/// Errors that leave the geometry, its names and the conformity of the mesh as the file describes them.
bool is_harmless(const std::string& error) {
    constexpr std::array about_sizes_and_display{"Unknown number option", "Unknown string option",
                                                 "Unknown color option",  "Unknown option",
                                                 "or plugin '",           "Unknown field",
                                                 "Cannot create field",   "Field ",
                                                 "No field with id",      "transfinite"};
    if (std::ranges::any_of(about_sizes_and_display,
                            [&](const char* part) { return error.find(part) != std::string::npos; }))
        return true;
    // Coherence, and BooleanFragments: one surface alone has nothing to be cut by
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    return error.find("Boolean fragments failed") != std::string::npos && surfaces.size() == 1;
}

}  // namespace

void mesh_geo(GmshSession& session, const fs::path& file, const std::map<std::string, double>& parameters) {
    const std::string where = file.string(), text = text_of(file);
    const Script geo(text);
    check_geo(file, geo, parameters);
    // Gmsh refuses to read an empty file: a comment makes sure that there is something.
    std::string definitions = "// parameters\n", comparisons = definitions;
    for (const auto& [name, value] : parameters) {
        definitions += fmt::format("{} = {:.17g};\n", name, value);
        comparisons += fmt::format(
            "If({0} != {1:.17g})\n Error(\"parameter {0} is overwritten by the file: define it there by "
            "DefineConstant[ {0} = ... ]\");\nEndIf\n",
            name, value);
    }
    const TemporaryFile before(fs::temp_directory_path(), definitions), after(fs::temp_directory_path(), comparisons);
    const std::unique_ptr<TemporaryFile> copy = mended(file, text, geo);
    if (copy) session.call(copy->path(), where);
    std::vector<Problem> crossings;
    session.run(
        where,
        [&] {
            gmsh::merge(before.path());
            gmsh::merge(copy ? copy->path() : where);
            gmsh::merge(after.path());
            std::vector<int> types;
            std::vector<std::vector<std::size_t>> elements, nodes;
            gmsh::model::mesh::getElements(types, elements, nodes, 2);
            if (types.empty()) {
                crossings = crossed_outlines(where);
                if (!crossings.empty()) return;
                gmsh::model::mesh::generate(2);
            }
            gmsh::model::mesh::setOrder(2);
        },
        is_harmless);
    if (!crossings.empty()) throw InputError(std::move(crossings));
}

}  // namespace gneiss
