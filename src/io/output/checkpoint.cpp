#include "io/output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/fingerprint.hpp"
#include "io/output/hdf5_handle.hpp"
#include "io/output/version.hpp"

namespace gneiss {
namespace {

using hdf5::checked;
using hdf5::Handle;
using Value = Checkpoint::Value;

constexpr const char* format_name = "gneiss checkpoint";

// The file is put together in memory, growing by this much, and written by write_atomically(): HDF5 itself does not
// recover from a full disk.
constexpr std::size_t memory_step = 1 << 22;  // bytes
constexpr const char* memory_name = "checkpoint in memory";

constexpr std::array<const char*, 5> type_names{"a number", "a whole number", "a text", "numbers", "whole numbers"};

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};

hid_t number_type(double) { return H5T_IEEE_F64LE; }
hid_t number_type(std::int64_t) { return H5T_STD_I64LE; }

/// A text of fixed length with one byte more than the text has, since HDF5 knows no empty ones.
Handle text_type(std::size_t length) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "cannot make a text type");
    checked(H5Tset_size(type, length + 1), "cannot make a text type");
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "cannot make a text type");
    checked(H5Tset_cset(type, H5T_CSET_UTF8), "cannot make a text type");
    return type;
}

Handle scalar_space() { return {H5Screate(H5S_SCALAR), H5Sclose, "cannot make a data space"}; }

Handle vector_space(hsize_t length) {
    return {H5Screate_simple(1, &length, nullptr), H5Sclose, "cannot make a data space"};
}

void write_data(hid_t file, const std::string& name, hid_t type, hid_t space, const void* data) {
    // Without times of writing equal content gives equal files.
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "cannot make a property list");
    checked(H5Pset_obj_track_times(creation, false), "cannot set a property");
    const Handle set(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                     "cannot make a data set");
    checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot write a data set");
}

void write_value(hid_t file, const std::string& name, const Value& value) {
    std::visit(
        Overloaded{[&](const std::string& text) {
                       write_data(file, name, text_type(text.size()), scalar_space(), text.c_str());
                   },
                   [&]<class T>(const std::vector<T>& vector) {
                       write_data(file, name, number_type(T{}), vector_space(vector.size()), vector.data());
                   },
                   [&](const auto& number) { write_data(file, name, number_type(number), scalar_space(), &number); }},
        value);
}

Value read_value(hid_t file, const std::string& name) {
    const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "cannot open a data set");
    const Handle type(H5Dget_type(set), H5Tclose, "cannot read a type");
    const Handle space(H5Dget_space(set), H5Sclose, "cannot read a data space");
    const bool is_scalar = checked(H5Sget_simple_extent_type(space), "cannot read a data space") == H5S_SCALAR;
    const auto length = static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space), "cannot read a length"));
    const auto read = [&](hid_t memory_type, void* data) {
        checked(H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot read a data set");
    };
    const auto read_numbers = [&]<class T>(T number) -> Value {
        if (is_scalar) {
            read(number_type(number), &number);
            return number;
        }
        std::vector<T> numbers(length);
        read(number_type(number), numbers.data());
        return numbers;
    };
    if (H5Tget_class(type) == H5T_STRING && is_scalar && H5Tis_variable_str(type) == 0) {
        std::string text(H5Tget_size(type), '\0');
        read(type, text.data());
        text.pop_back();
        return text;
    }
    if (H5Tequal(type, H5T_IEEE_F64LE) > 0) return read_numbers(double{});
    if (H5Tequal(type, H5T_STD_I64LE) > 0) return read_numbers(std::int64_t{});
    throw std::runtime_error("entry '" + name + "' is of a type that checkpoints do not have");
}

void write_attribute(hid_t file, const char* name, hid_t type, const void* data) {
    const Handle attribute(H5Acreate2(file, name, type, scalar_space(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           "cannot make an attribute");
    checked(H5Awrite(attribute, type, data), "cannot write an attribute");
}

std::string read_text_attribute(hid_t file, const char* name) {
    const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, "an attribute is missing");
    const Handle type(H5Aget_type(attribute), H5Tclose, "cannot read a type");
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
        throw std::runtime_error(std::string("attribute '") + name + "' is no text");
    std::string text(H5Tget_size(type), '\0');
    checked(H5Aread(attribute, type, text.data()), "cannot read an attribute");
    text.pop_back();
    return text;
}

std::int64_t read_whole_attribute(hid_t file, const char* name) {
    const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, "an attribute is missing");
    std::int64_t value = 0;
    checked(H5Aread(attribute, H5T_NATIVE_INT64, &value), "cannot read an attribute");
    return value;
}

/// Names of the root's links in the order in which they were made.
std::vector<std::string> link_names(hid_t file) {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t*, void* result) -> herr_t {
        static_cast<std::vector<std::string>*>(result)->emplace_back(name);
        return 0;
    };
    checked(H5Literate(file, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add, &names), "cannot list the entries");
    return names;
}

/// Access to a file that lives in memory only.
Handle memory_access() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "cannot make a property list");
    checked(H5Pset_fapl_core(access, memory_step, false), "cannot set a property");
    return access;
}

}  // namespace

Checkpoint::Checkpoint(std::string deck_fingerprint)
    : deck_fingerprint_(std::move(deck_fingerprint)), program_version_(version_string()) {}

void Checkpoint::set(std::string_view name, Value value) {
    if (name.empty() || name == "." || name.find('/') != std::string_view::npos ||
        name.find('\0') != std::string_view::npos)
        throw std::invalid_argument("Checkpoint: '" + std::string(name) + "' is no name for an entry");
    for (auto& [existing, old] : entries_) {
        if (existing == name) {
            old = std::move(value);
            return;
        }
    }
    entries_.emplace_back(name, std::move(value));
}

std::vector<std::string> Checkpoint::names() const {
    std::vector<std::string> result;
    for (const auto& [name, value] : entries_) result.push_back(name);
    return result;
}

const Value* Checkpoint::find(std::string_view name) const {
    for (const auto& [existing, value] : entries_)
        if (existing == name) return &value;
    return nullptr;
}

const Value& Checkpoint::entry(std::string_view name) const {
    if (const Value* value = find(name)) return *value;
    throw InputError(source_, "has no entry '" + std::string(name) + "'");
}

void Checkpoint::throw_wrong_type(std::string_view name, const Value& found, const Value& wanted) const {
    throw InputError(source_, fmt::format("entry '{}' is {}, needed: {}", name, type_names[found.index()],
                                          type_names[wanted.index()]));
}

void Checkpoint::throw_wrong_size(std::string_view name, std::size_t found, std::size_t wanted) const {
    throw InputError(source_, fmt::format("entry '{}' has length {}, needed: {}", name, found, wanted));
}

void Checkpoint::save(const std::filesystem::path& path) const {
    const hdf5::Silence silence;
    std::string image;
    try {
        const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "cannot make a property list");
        checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
                "cannot set a property");
        checked(H5Pset_obj_track_times(creation, false), "cannot set a property");
        const Handle file(H5Fcreate(memory_name, H5F_ACC_TRUNC, creation, memory_access()), H5Fclose,
                          "cannot make a file in memory");
        const auto write_text = [&](const char* name, const std::string& text) {
            write_attribute(file, name, text_type(text.size()), text.c_str());
        };
        write_text("format", format_name);
        write_attribute(file, "format_version", H5T_STD_I64LE, &format_version);
        write_text("program_version", program_version_);
        write_text("deck_fingerprint", deck_fingerprint_);
        for (const auto& [name, value] : entries_) write_value(file, name, value);

        checked(H5Fflush(file, H5F_SCOPE_LOCAL), "cannot finish the file");
        image.resize(static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0), "cannot finish the file")));
        checked(H5Fget_file_image(file, image.data(), image.size()), "cannot finish the file");
    } catch (const hdf5::Error& error) {
        throw IoError(path, error.what());
    }
    image += fingerprint_text(image);
    write_atomically(path, image);
}

Checkpoint Checkpoint::load(const std::filesystem::path& path) {
    const hdf5::Silence silence;
    const std::string where = path.string();
    if (std::filesystem::is_directory(path))
        throw InputError(where, "is a folder, needed: a checkpoint.h5, as a run leaves it among its results");
    if (!std::filesystem::exists(path))
        throw InputError(where, "no such checkpoint; a run leaves checkpoint.h5 among its results");
    std::string image;
    try {
        image = read_file(path);
    } catch (const IoError& error) {
        throw InputError("", error.what());
    }
    constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);  // [HDF5 File Format Specification, II.A]
    if (!image.starts_with(signature)) throw InputError(where, "is no checkpoint: it is not an HDF5 file");
    // Damaged files are kept from HDF5, which does not always recover from what it finds in them.
    const std::size_t length = image.size() - std::min(image.size(), fingerprint_text({}).size());
    const std::string stored = image.substr(length);
    if (!stored.starts_with("fnv1a64:"))
        throw InputError(where, "is cut off, or an HDF5 file of something else: the fingerprint at its end is missing");
    image.resize(length);
    if (fingerprint_text(image) != stored)
        throw InputError(where, fmt::format("is damaged: it was written with the fingerprint {}, but has {}", stored,
                                            fingerprint_text(image)));

    Checkpoint checkpoint;
    checkpoint.source_ = where;
    try {
        const Handle access = memory_access();
        checked(H5Pset_file_image(access, image.data(), image.size()), "cannot take the file into memory");
        const Handle file(H5Fopen(memory_name, H5F_ACC_RDONLY, access), H5Fclose, "cannot open the file");
        if (H5Aexists(file, "format") <= 0 || read_text_attribute(file, "format") != format_name)
            throw InputError(where, "is no checkpoint: this HDF5 file was written by something else");
        const std::int64_t found_version = read_whole_attribute(file, "format_version");
        checkpoint.program_version_ = read_text_attribute(file, "program_version");
        if (found_version != format_version)
            throw InputError(where,
                             fmt::format("has checkpoint format {}, written by version {}; this is version {}, "
                                         "which reads format {}",
                                         found_version, checkpoint.program_version_, version_string(), format_version));
        checkpoint.deck_fingerprint_ = read_text_attribute(file, "deck_fingerprint");
        for (const std::string& name : link_names(file)) checkpoint.set(name, read_value(file, name));
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(where, std::string("cannot be read: ") + error.what());
    }
    return checkpoint;
}

}  // namespace gneiss
