#pragma once
// What contact keeps in State::history: per contactor point the bodies that it is in, and what has been dissipated.
//
//     dissipated by friction, by restitution (J)
//     which triangle each slot of each point touches, -1: the slot is free    shape (slots, points)
//     what it remembers there; of a free slot nothing is meant by it          shape (slots, points, 8)
//
// Free slots cost one number each: what they held is neither cleared nor read. Most points are in one body at most, so
// that what is read stands one behind the other.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "contact/contact_point.hpp"

namespace gneiss {

/// Bodies that a point may be in at a time. In one more it is pushed out without friction and without loss.
inline constexpr std::size_t contact_slots = 3;

/// Number is double, or const double.
template <class Number>
class ContactMemory {
public:
    static constexpr std::size_t n_sums = 2;
    static constexpr std::size_t n_members = 8;  ///< the last one is not used: members are read in pairs
    static std::size_t size(std::size_t n_points) { return n_sums + n_points * contact_slots * (1 + n_members); }

    /// @param values  shape (size(n_points))
    ContactMemory(std::span<Number> values, std::size_t n_points) : values_(values), n_points_(n_points) {}

    Number& friction() const { return values_[0]; }
    Number& restitution() const { return values_[1]; }
    /// Triangles that one slot of the points touches, shape (n_points).
    std::span<Number> triangles(std::size_t slot) const {
        return values_.subspan(n_sums + slot * n_points_, n_points_);
    }
    std::int32_t triangle(std::size_t point, std::size_t slot) const {
        return static_cast<std::int32_t>(triangles(slot)[point]);
    }
    ContactHistory<double> at(std::size_t point, std::size_t slot) const {
        const Number* v = &values_[place(point, slot)];
        return {1.0, {v[0], v[1]}, {v[2], v[3]}, v[4], v[5], v[6]};
    }
    void set(std::size_t point, std::size_t slot, std::int32_t triangle, const ContactHistory<double>& history) const {
        triangles(slot)[point] = triangle;
        Number* v = &values_[place(point, slot)];
        v[0] = history.anchor.x;
        v[1] = history.anchor.y;
        v[2] = history.slip.x;
        v[3] = history.slip.y;
        v[4] = history.slip_limit;
        v[5] = history.deepest;
        v[6] = history.rest;
    }
    /// What points remember as pairs of numbers: four in a row for a point and a slot, the first of them by its
    /// number.
    Number* pairs() const { return &values_[place(0, 0)]; }
    std::size_t pair_of(std::size_t point, std::size_t slot) const {
        return (slot * n_points_ + point) * n_members / 2;
    }
    void free_all() const { std::fill_n(values_.begin() + n_sums, contact_slots * n_points_, -1.0); }

private:
    std::size_t place(std::size_t point, std::size_t slot) const {
        return n_sums + contact_slots * n_points_ + (slot * n_points_ + point) * n_members;
    }

    std::span<Number> values_;
    std::size_t n_points_;
};

}  // namespace gneiss
