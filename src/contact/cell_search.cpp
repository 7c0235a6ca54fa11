#include "contact/cell_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "base/vec2.hpp"
#include "contact/radix_sort.hpp"

namespace gneiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Positions further out are not known to 1e-3 of a cell.
constexpr double most_cells = 1099511627776.0;  // 2^40

/// More sizes of cells than that share the largest: elements do not span a factor of 2^31.
constexpr int most_levels = 32;

Vec2<double> at(std::span<const double> x, std::int32_t node) {
    const std::size_t k = 2 * static_cast<std::size_t>(node);
    return {x[k], x[k + 1]};
}

/// Bits that tell n numbers apart.
int bits_for(std::uint64_t n) { return n <= 1 ? 0 : std::bit_width(n - 1); }

/// The half-planes of a triangle, moved outwards by the skin: n . x <= offset.
class WidenedTriangle {
public:
    WidenedTriangle(std::span<const double> x, const std::array<std::int32_t, 3>& nodes, double skin) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec2<double> a = at(x, nodes[i]), edge = at(x, nodes[(i + 1) % 3]) - a;
            normal_[i] = {edge.y, -edge.x};
            offset_[i] = dot(normal_[i], a) + skin * std::sqrt(dot(edge, edge));
        }
    }

    bool contains(double x, double y) const {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) inside &= normal_[i].x * x + normal_[i].y * y <= offset_[i];
        return inside;
    }

    /// False only if one half-plane leaves out the whole box.
    bool touches_box(double x_min, double x_max, double y_min, double y_max) const {
        bool touches = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = normal_[i].x > 0 ? x_min : x_max, y = normal_[i].y > 0 ? y_min : y_max;
            touches &= normal_[i].x * x + normal_[i].y * y <= offset_[i];
        }
        return touches;
    }

private:
    std::array<Vec2<double>, 3> normal_;  // not of unit length
    std::array<double, 3> offset_;
};

std::int64_t cell_of(double x, double cells_per_m) { return static_cast<std::int64_t>(std::floor(x * cells_per_m)); }

}  // namespace

std::span<const ContactCandidate> CellSearch::search(const ContactSurroundings& what, double skin) {
    assert(skin >= 0 && what.points != nullptr);
    candidates_.clear();
    if (what.points->size() == 0 || what.triangles.empty()) return candidates_;
    place_points(what);
    measure_triangles(what, skin);
    choose_numbers(what);
    render_triangles(what, skin);
    drop_points();
    sweep(what, skin);
    sort_candidates(what.points->size());
    return candidates_;
}

void CellSearch::place_points(const ContactSurroundings& what) {
    const ContactorPoints& points = *what.points;
    point_x_.resize(points.size());
    point_y_.resize(points.size());
    parallel_ranges(points.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const double w = points.weight_b[i];
            const Vec2<double> p = (1 - w) * at(what.x, points.a[i]) + w * at(what.x, points.b[i]);
            point_x_[i] = p.x;
            point_y_[i] = p.y;
        }
    });
}

void CellSearch::measure_triangles(const ContactSurroundings& what, double skin) {
    boxes_.resize(what.triangles.size());
    levels_.resize(what.triangles.size());
    parallel_ranges(what.triangles.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            const auto& [i, j, k] = what.triangles[t];
            const Vec2<double> a = at(what.x, i), b = at(what.x, j), c = at(what.x, k);
            boxes_[t] = {std::min({a.x, b.x, c.x}) - skin, std::max({a.x, b.x, c.x}) + skin,
                         std::min({a.y, b.y, c.y}) - skin, std::max({a.y, b.y, c.y}) + skin};
        }
    });

    for (std::size_t k = 0; k < what.x.size(); ++k)
        if (!std::isfinite(what.x[k]))
            throw RecoverableError(fmt::format("contact search: position of node {} is not finite", k / 2));

    // Level 0 has cells as large as the largest box, each further one cells half as large: the sizes of a uniform mesh
    // share one level.
    const auto extent = [](const Box& box) { return std::max(box.x_max - box.x_min, box.y_max - box.y_min); };
    double largest = 0;
    for (const Box& box : boxes_) largest = std::max(largest, extent(box));
    if (largest == 0) largest = 1;  // all are points, and there is no skin
    largest *= 1 + 1e-3;            // a box is smaller than a cell, and stays so when positions are rounded to cells
    const auto level_of = [&](const Box& box) {
        const double ratio = largest / extent(box);  // > 1
        return ratio < std::ldexp(1.0, most_levels - 1) ? static_cast<std::size_t>(std::ilogb(ratio))
                                                        : std::size_t{most_levels - 1};
    };
    std::array<bool, most_levels> occurs{};
    for (std::size_t t = 0; t < boxes_.size(); ++t) {
        const std::size_t level = level_of(boxes_[t]);
        levels_[t] = static_cast<std::int8_t>(level);
        occurs[level] = true;
    }
    std::array<std::int8_t, most_levels> number{};
    cells_per_m_.clear();
    for (std::size_t level = 0; level < most_levels; ++level) {
        number[level] = static_cast<std::int8_t>(cells_per_m_.size());
        if (occurs[level]) cells_per_m_.push_back(std::ldexp(1.0, static_cast<int>(level)) / largest);
    }
    for (std::int8_t& level : levels_) level = number[static_cast<std::size_t>(level)];
}

void CellSearch::choose_numbers(const ContactSurroundings& what) {
    const std::size_t n_triangles = what.triangles.size(), n_points = what.points->size();
    double x_min = infinity, x_max = -infinity, y_min = infinity, y_max = -infinity;
    for (std::size_t i = 0; i < n_points; ++i) {
        x_min = std::min(x_min, point_x_[i]);
        x_max = std::max(x_max, point_x_[i]);
        y_min = std::min(y_min, point_y_[i]);
        y_max = std::max(y_max, point_y_[i]);
    }
    for (const Box& box : boxes_) {
        x_min = std::min(x_min, box.x_min);
        x_max = std::max(x_max, box.x_max);
        y_min = std::min(y_min, box.y_min);
        y_max = std::max(y_max, box.y_max);
    }
    const double finest = cells_per_m_.back();
    const double farthest = std::max({-x_min, x_max, -y_min, y_max});
    if (!(farthest * finest < most_cells)) {
        const auto at = std::max_element(what.x.begin(), what.x.end(),
                                         [](double p, double q) { return std::abs(p) < std::abs(q); });
        throw RecoverableError(fmt::format("contact search: node {} is {:.3g} m from the origin, more than 2^40 cells",
                                           (at - what.x.begin()) / 2, farthest));
    }
    const auto bits_across = [&](double low, double high) {
        return bits_for(static_cast<std::uint64_t>((high - low) * finest) + 4);
    };
    const int level_bits = bits_for(cells_per_m_.size());
    item_bits_ = std::max(bits_for(n_triangles), bits_for(n_points));
    // at least four rows and columns: the cells of one triangle differ
    column_bits_ = bits_across(x_min, x_max);
    row_bits_ = bits_across(y_min, y_max);
    const int available = 64 - item_bits_ - level_bits;
    if (column_bits_ + row_bits_ > available) {
        const int half = available / 2;
        if (row_bits_ <= half)
            column_bits_ = available - row_bits_;
        else if (column_bits_ <= half)
            row_bits_ = available - column_bits_;
        else
            column_bits_ = row_bits_ = half;
    }
    all_bits_ = item_bits_ + column_bits_ + row_bits_ + level_bits;
}

std::uint64_t CellSearch::cell_number(int level, std::int64_t i, std::int64_t j) const {
    const auto column = static_cast<std::uint64_t>(i) & ((std::uint64_t{1} << column_bits_) - 1);
    const auto row = static_cast<std::uint64_t>(j) & ((std::uint64_t{1} << row_bits_) - 1);
    return (((static_cast<std::uint64_t>(level) << row_bits_) | row) << column_bits_) | column;
}

void CellSearch::render_triangles(const ContactSurroundings& what, double skin) {
    rendered_.clear();
    for (std::size_t t = 0; t < boxes_.size(); ++t) {
        const Box& box = boxes_[t];
        const double cells = cells_per_m_[static_cast<std::size_t>(levels_[t])], side = 1 / cells;
        const std::int64_t i_min = cell_of(box.x_min, cells), i_max = cell_of(box.x_max, cells);
        const std::int64_t j_min = cell_of(box.y_min, cells), j_max = cell_of(box.y_max, cells);
        const bool several = i_min != i_max && j_min != j_max;  // else the box has no corner that could stay empty
        const WidenedTriangle triangle(what.x, what.triangles[t], skin);
        // A point near the edge of a cell may have been rounded into it from outside.
        const double rounding = 1e-3 * side;
        for (std::int64_t j = j_min; j <= j_max; ++j)
            for (std::int64_t i = i_min; i <= i_max; ++i) {
                const double x = static_cast<double>(i) * side, y = static_cast<double>(j) * side;
                if (!several ||
                    triangle.touches_box(x - rounding, x + side + rounding, y - rounding, y + side + rounding))
                    rendered_.push_back(cell_number(levels_[t], i, j) << item_bits_ | t);
            }
    }
    radix_sort(rendered_, scratch_, item_bits_, all_bits_);
}

void CellSearch::drop_points() {
    const std::size_t n_points = point_x_.size(), n_levels = cells_per_m_.size();
    dropped_.resize(n_points * n_levels);
    parallel_ranges(n_points, [&](std::size_t first, std::size_t last) {
        for (std::size_t level = 0; level < n_levels; ++level)
            for (std::size_t p = first; p < last; ++p) {
                const double cells = cells_per_m_[level];
                const std::uint64_t cell =
                    cell_number(static_cast<int>(level), cell_of(point_x_[p], cells), cell_of(point_y_[p], cells));
                dropped_[level * n_points + p] = cell << item_bits_ | p;
            }
    });
    radix_sort(dropped_, scratch_, item_bits_, all_bits_);
    dropped_x_.resize(dropped_.size());
    dropped_y_.resize(dropped_.size());
    const std::uint64_t item = (std::uint64_t{1} << item_bits_) - 1;
    parallel_ranges(dropped_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            dropped_x_[k] = point_x_[dropped_[k] & item];
            dropped_y_[k] = point_y_[dropped_[k] & item];
        }
    });
}

void CellSearch::sweep(const ContactSurroundings& what, double skin) {
    const std::uint64_t item = (std::uint64_t{1} << item_bits_) - 1;
    const std::size_t n_ranges = (dropped_.size() + parallel_range - 1) / parallel_range;
    if (found_.size() < n_ranges) found_.resize(n_ranges);
    for (auto& found : found_) found.clear();
    parallel_ranges(dropped_.size(), [&](std::size_t first, std::size_t last) {
        std::vector<ContactCandidate>& found = found_[first / parallel_range];
        constexpr std::size_t block_size = 64;
        std::array<std::size_t, block_size> near;
        auto triangle = std::lower_bound(rendered_.begin(), rendered_.end(), dropped_[first] & ~item);
        for (std::size_t run = first; run < last;) {
            const std::uint64_t cell = dropped_[run] >> item_bits_;
            std::size_t run_end = run + 1;
            while (run_end < last && dropped_[run_end] >> item_bits_ == cell) ++run_end;
            while (triangle != rendered_.end() && *triangle >> item_bits_ < cell) ++triangle;
            for (; triangle != rendered_.end() && *triangle >> item_bits_ == cell; ++triangle) {
                const std::size_t t = *triangle & item;
                const auto& nodes = what.triangles[t];
                const Box& box = boxes_[t];
                const WidenedTriangle widened(what.x, nodes, skin);
                for (std::size_t block = run; block < run_end; block += block_size) {
                    // the box first, without branches: what they would predict is a toss-up
                    const std::size_t block_end = std::min(block + block_size, run_end);
                    std::size_t n_near = 0;
                    for (std::size_t k = block; k < block_end; ++k) {
                        const double x = dropped_x_[k], y = dropped_y_[k];
                        near[n_near] = k;
                        n_near += (x >= box.x_min) & (x <= box.x_max) & (y >= box.y_min) & (y <= box.y_max);
                    }
                    for (std::size_t i = 0; i < n_near; ++i) {
                        const std::size_t p = dropped_[near[i]] & item;
                        bool has_a = false, has_b = false;
                        for (const std::int32_t node : nodes) {
                            has_a |= node == what.points->a[p];
                            has_b |= node == what.points->b[p];
                        }
                        if (!(has_a && has_b) && widened.contains(dropped_x_[near[i]], dropped_y_[near[i]]))
                            found.push_back({static_cast<std::int32_t>(p), static_cast<std::int32_t>(t)});
                    }
                }
            }
            run = run_end;
        }
    });
}

void CellSearch::sort_candidates(std::size_t n_points) {
    first_of_point_.assign(n_points + 1, 0);
    std::size_t n = 0;
    for (const auto& found : found_) {
        n += found.size();
        for (const ContactCandidate& pair : found) ++first_of_point_[static_cast<std::size_t>(pair.point) + 1];
    }
    assert(n <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()));
    for (std::size_t p = 0; p < n_points; ++p) first_of_point_[p + 1] += first_of_point_[p];
    candidates_.resize(n);
    // Filling moves the first of each point to the first of the next one.
    for (const auto& found : found_)
        for (const ContactCandidate& pair : found)
            candidates_[static_cast<std::size_t>(first_of_point_[static_cast<std::size_t>(pair.point)]++)] = pair;
    parallel_ranges(n_points, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            const auto begin = candidates_.begin() + (p == 0 ? 0 : first_of_point_[p - 1]);
            std::sort(begin, candidates_.begin() + first_of_point_[p]);
        }
    });
}

}  // namespace gneiss
