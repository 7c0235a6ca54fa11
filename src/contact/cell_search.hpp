#pragma once
// Which contactor points may touch which triangles: a search by square cells whose cost grows linearly with the number
// of triangles, in the manner of Munjiza, Rougier and John (2006), "MR linear contact detection algorithm",
// International Journal for Numerical Methods in Engineering 66, 46-71: targets are rendered onto the cells they touch,
// contactor points dropped into theirs, both sorted by cell and swept.
//
// Each size of cells is half the next larger one. A triangle is rendered onto the smallest that exceed its own box with
// the skin, so it touches four cells at most, whatever the sizes of the others; points are dropped into the cells of
// every size that occurs. Triangles of very different sizes therefore cost one more row of points per factor of two
// between them. Cells that are far apart share a number once there are more than fit into it: such strangers are told
// apart by geometry, so that a fragment flying off costs nothing but wider numbers.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contactor_points.hpp"

namespace gneiss {

/// A contactor point and a triangle that it may touch, by their numbers.
struct ContactCandidate {
    std::int32_t point, triangle;

    friend auto operator<=>(const ContactCandidate&, const ContactCandidate&) = default;
};
/// The ends of the point's edge and the three of the target.
inline constexpr std::size_t nodes_per_candidate = 5;

/// What is searched. Spans must outlive the call only.
struct ContactSurroundings {
    std::span<const double> x;                               ///< current positions, m, shape (2 n_nodes)
    std::span<const std::array<std::int32_t, 3>> triangles;  ///< nodes of the targets, counter-clockwise
    const ContactorPoints* points = nullptr;
};

/// Keeps its arrays: once they have grown to the size of the problem, a search allocates nothing.
class CellSearch {
public:
    /// All pairs whose triangle does not have both ends of the point's edge, and whose point lies, to within the skin,
    /// in the box of the triangle and on the inner side of each of its edges. So every pair closer than the skin is
    /// among them.
    /// @param skin  m, >= 0: pairs remain complete while no node has moved more than half of it
    /// @returns ascending by point, then triangle, the same for any number of threads; valid until the next search
    /// @throws RecoverableError if a position is not finite, or further from the origin than 2^40 cells; the message
    /// gives the node
    std::span<const ContactCandidate> search(const ContactSurroundings& what, double skin);

    /// The pairs of the last search.
    std::span<const ContactCandidate> candidates() const { return candidates_; }

private:
    struct Box {
        double x_min, x_max, y_min, y_max;  ///< with the skin, m
    };

    void place_points(const ContactSurroundings& what);
    void measure_triangles(const ContactSurroundings& what, double skin);
    void choose_numbers(const ContactSurroundings& what);
    std::uint64_t cell_number(int level, std::int64_t i, std::int64_t j) const;
    void render_triangles(const ContactSurroundings& what, double skin);
    void drop_points();
    void sweep(const ContactSurroundings& what, double skin);
    void sort_candidates(std::size_t n_points);

    std::vector<double> point_x_, point_y_;  // of the contactor points

    // triangles
    std::vector<Box> boxes_;
    std::vector<std::int8_t> levels_;  // which size of cells

    // sizes of cells that occur, and how cells are numbered: level, row, column, from high bits to low
    std::vector<double> cells_per_m_;
    int column_bits_ = 0, row_bits_ = 0, item_bits_ = 0, all_bits_ = 0;

    // (cell, item) in one number each, sorted by cell
    std::vector<std::uint64_t> rendered_, dropped_, scratch_;
    std::vector<double> dropped_x_, dropped_y_;  // positions in the order of dropped_

    std::vector<std::vector<ContactCandidate>> found_;  // per range of dropped points
    std::vector<std::int32_t> first_of_point_;
    std::vector<ContactCandidate> candidates_;
};

}  // namespace gneiss
