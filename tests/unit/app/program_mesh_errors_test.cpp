// Bad meshes, as a user sees them: elements and nodes by the numbers of the file, exit code 2.

#include <gmock/gmock.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Four triangles 21 to 24 around the middle of a square, and node 9, which belongs to nothing.
///   13------12
///   | \ 23 / |
///   |24 14 22|
///   | / 21 \ |
///   10------11
const std::string square_msh = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
1 0 0 0 2 2 0 0 0
$EndEntities
$Nodes
1 6 9 14
2 1 0 6
9
10
11
12
13
14
5 5 0
0 0 0
2 0 0
2 2 0
0 2 0
1 1 0
$EndNodes
$Elements
1 4 21 24
2 1 2 4
21 10 11 14
22 11 12 14
23 12 13 14
24 13 10 14
$EndElements
)";

const std::string mesh_deck = R"toml(
mesh = { file = "square.msh" }
solid = { plane = "strain" }
run = { t_end = 1e-4 }
[[material]]
density = 1000.0
constants = { E = 1e9, nu = 0.25 }
)toml";

class ProgramMeshErrors : public test::ProgramTest {
protected:
    Ended check(const std::string& what, const std::string& by) const {
        std::string mesh = square_msh;
        const std::size_t at = mesh.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        put("case.toml", mesh_deck);
        put("square.msh", mesh.replace(at, what.size(), by));
        return gneiss({"check", "case.toml", "--threads", "1"});
    }
};

TEST_F(ProgramMeshErrors, Sound_UnusedNode_IsWarnedOf) {
    const Ended ended = check("1 1 0\n", "1 1 0\n");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("warning             mesh: left out, they belong to no element: node 9\n"));
}

TEST_F(ProgramMeshErrors, EveryClass_NamesTheElements) {
    struct Bad {
        std::string what, by, message;
    };
    for (const Bad& bad : std::vector<Bad>{
             {"1 1 0\n", "1 3 0\n", "overlapping, two on the same side of their common edge: elements 22, 23 and 24"},
             {"22 11 12 14", "22 10 11 14", "duplicated, on the same three corners: elements 21 and 22"},
             {"1 1 0\n", "1 0 0\n", "zero area, of the whole or of one of its four sub-triangles: element 21"},
             {"22 11 12 14", "22 11 11 14", "element 22"},
             {"22 11 12 14", "22 11 99 14", "99"},
             {"1 1 0\n", "nan 1 0\n", "14"},
         }) {
        const Ended ended = check(bad.what, bad.by);
        EXPECT_EQ(ended.code, 2) << bad.by;
        EXPECT_THAT(ended.err, AllOf(HasSubstr("square.msh"), HasSubstr(bad.message))) << bad.by;
    }
}

}  // namespace
}  // namespace gneiss
