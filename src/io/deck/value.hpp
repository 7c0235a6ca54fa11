#pragma once
// One value of a deck while it is read: where it stands, what it is called, and how it is turned into a number, a name,
// …

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.hpp"
#include "model/options.hpp"

namespace gneiss::deck {

/// A place in the deck or in a --set argument.
struct Position {
    std::string source;  ///< name of the file, or "--set key=value"
    unsigned line = 0;   ///< 1-based; 0 for a --set argument
    unsigned column = 0;

    bool is_override() const { return source.starts_with(override_prefix); }
    static constexpr std::string_view override_prefix = "--set ";
    std::string text() const;
};

/// Where a node begins; `otherwise` for nodes that come from no text.
Position position_of(const toml::source_region& region, const Position& otherwise);

/// Everything found wrong so far, and what one section must know of another.
class Findings {
public:
    void add(const Position& where, std::string message);
    /// @throws InputError with all problems in the order of the file, those of --set last; returns if there are none
    void throw_if_any() const;

    std::size_t count() const { return findings_.size(); }

    /// What is no mistake, and yet to be told: "case.toml:12:8: key `k`: …".
    void note(const Position& where, std::string_view key, std::string_view message);
    /// Notes on keys of [compare], or on all others, in the order in which they came.
    std::vector<std::string> notes(bool of_compare) const;

    std::optional<Plane> plane;                   ///< [solid], once it has been read without error
    std::optional<Volumetric> volumetric;         ///< likewise
    std::optional<std::filesystem::path> folder;  ///< of the deck: files that it names are looked for there

private:
    struct Finding {
        Position where;
        std::string message;
    };
    std::vector<Finding> findings_;
    std::vector<std::string> notes_, notes_on_compare_;
};

/// Range of a number; nan and infinities lie in no range.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = true, high_open = true;

    bool contains(double value) const;
    bool is_any() const;
    std::string text() const;  ///< "> 0", "(0, 1]", "any"
    /// " > 0 kg/m³", as it follows "must be" or "must be a number"
    std::string requirement(std::string_view unit) const;
};
inline Range above(double low) { return {.low = low}; }
inline Range at_least(double low) { return {.low = low, .low_open = false}; }
inline Range between(double low, double high) { return {low, high, false, false}; }
inline Range open_between(double low, double high) { return {low, high, true, true}; }
inline Range closed(double low, double high) { return {low, high, false, false}; }
inline Range half_open(double low, double high) { return {low, high, true, false}; }  ///< (low, high]

/// What a number must fulfil.
struct NumberRule {
    Range range;
    std::string_view unit;
};

/// A value with its name and place. The read functions report what is wrong and then return false or nothing.
class Value {
public:
    Value(Findings& findings, const toml::node& node, std::string key, const Position& around);

    Findings& findings() const { return *findings_; }
    const toml::node& node() const { return *node_; }
    const std::string& key() const { return key_; }
    const Position& where() const { return where_; }

    void problem(std::string_view message) const;  ///< "key `k`: message"
    void refuse(std::string_view must) const;      ///< "key `k`: given V, must be MUST"
    std::string given() const;                     ///< the value as it would be written, shortened

    /// The elements if this is an array of `size` elements (any number of them without `size`); reports otherwise.
    std::optional<std::vector<Value>> elements(std::optional<std::size_t> size, std::string_view of_what) const;

    bool read(double& out, const NumberRule& rule) const;
    bool read(int& out, const NumberRule& rule) const;
    bool read(bool& out) const;
    bool read(std::string& out) const;  ///< must not be empty
    /// A number within the rule, or an expression of the variables, compiled once to find its faults.
    bool read(Formula& out, const NumberRule& rule, std::string_view variables) const;
    bool read(std::span<double> out, const NumberRule& rule) const;  ///< as many numbers as out has places
    bool read(std::vector<double>& out, const NumberRule& rule) const;

private:
    bool expression(const Formula& formula, std::string_view variables) const;

    Findings* findings_;
    const toml::node* node_;
    std::string key_;
    Position where_;
};

}  // namespace gneiss::deck
