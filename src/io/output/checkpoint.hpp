#pragma once
// Everything that a run needs to go on where it stopped, in one HDF5 file.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gneiss {

/// An ordered list of named values. It knows nothing of what they mean: system, integrator and output put in what they
/// need. Every bit of every number comes back, those of NaNs included.
///
///     Checkpoint checkpoint(fingerprint_text(deck));
///     checkpoint.set("state.u", u);
///     checkpoint.save(folder / "checkpoint.h5");
///     u = Checkpoint::load(path).get<std::vector<double>>("state.u");
///
/// In the file each entry is a data set of the root group, in order; the attributes of the root are format,
/// format_version, program_version and deck_fingerprint. After HDF5's own bytes stands fingerprint_text() of them,
/// which its tools do not mind: damage is found before HDF5 sees it. Equal content gives equal bytes.
class Checkpoint {
public:
    using Value = std::variant<double, std::int64_t, std::string, std::vector<double>, std::vector<std::int64_t>>;

    /// Number of the layout above; a file of another one is refused.
    static constexpr std::int64_t format_version = 1;

    explicit Checkpoint(std::string deck_fingerprint = {});

    /// Adds an entry, or replaces the one of that name where it stands.
    /// @param name  not empty, without '/', which HDF5 takes for a folder: "state.u"
    /// @throws std::invalid_argument for another name
    void set(std::string_view name, Value value);

    bool contains(std::string_view name) const { return find(name) != nullptr; }

    /// @throws InputError if there is no such entry, or it is of another type
    template <class T>
    const T& get(std::string_view name) const {
        const Value& value = entry(name);
        if (const T* typed = std::get_if<T>(&value)) return *typed;
        throw_wrong_type(name, value, Value(T{}));
    }

    /// A vector whose length is known. @throws InputError also if it has another length than `size`
    template <class T>
    const T& get(std::string_view name, std::size_t size) const {
        const T& vector = get<T>(name);
        if (vector.size() != size) throw_wrong_size(name, vector.size(), size);
        return vector;
    }

    std::vector<std::string> names() const;

    /// Fingerprint of the deck of the run that wrote it, and the version of the program that did.
    const std::string& deck_fingerprint() const { return deck_fingerprint_; }
    const std::string& program_version() const { return program_version_; }

    /// Writes the file whole or not at all. @throws IoError
    void save(const std::filesystem::path& path) const;

    /// @throws InputError if there is no such file, it is no checkpoint, damaged, or of another format version;
    ///         the message says which
    static Checkpoint load(const std::filesystem::path& path);

private:
    const Value* find(std::string_view name) const;
    const Value& entry(std::string_view name) const;
    [[noreturn]] void throw_wrong_type(std::string_view name, const Value& found, const Value& wanted) const;
    [[noreturn]] void throw_wrong_size(std::string_view name, std::size_t found, std::size_t wanted) const;

    std::vector<std::pair<std::string, Value>> entries_;  // few: a linear search is as good as any
    std::string deck_fingerprint_;
    std::string program_version_;
    std::string source_ = "checkpoint";  // the file it came from, for messages
};

}  // namespace gneiss
