#pragma once
// Files of Gmsh in a folder of their own, as the tests of its reader write them.

#include <map>

#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss::testing {

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

class GmshFile : public ::testing::Test {
protected:
    Mesh read(const std::string& name, const std::string& text, bool curved = true, bool compt = true) {
        folder.write(name, text);
        MeshOptions options;
        options.source = MeshOptions::Source::file;
        options.file = name;
        options.parameters = parameters;
        options.curved = curved;
        report = {};
        return make_mesh(options, compt, folder.path(), &report);
    }
    std::string error_of(const std::string& name, const std::string& text) {
        return input_error_of([&] { read(name, text); });
    }
    std::string in_folder(const std::string& name) const { return (folder.path() / name).string(); }

    TemporaryFolder folder;
    std::map<std::string, double> parameters;
    MeshReport report;
};

}  // namespace gneiss::testing
