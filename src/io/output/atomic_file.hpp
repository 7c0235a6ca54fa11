#pragma once
// Files that appear whole or not at all: written beside their place, forced to the disk, then renamed.

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gneiss {

/// A file could not be written or read: disk full, no permission, a folder that is none.
/// The message reads "PATH: what failed: reason of the operating system".
class IoError : public std::runtime_error {
public:
    IoError(std::filesystem::path path, const std::string& reason);

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// IoError from the present value of errno.
IoError io_error_from_errno(const std::filesystem::path& path, std::string_view what_failed);

/// Where write_atomically() writes before the rename: PATH.part, in the same folder and so on the same file system.
std::filesystem::path part_path(const std::filesystem::path& path);

/// Lets `writer` write a file of the name it is given, forces it to the disk and renames it to `path`. A file that
/// stood at `path` stays untouched until the rename. If anything fails, the part is removed and the exception goes on.
/// @throws IoError with the path and the reason
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& writer);

/// The same with the descriptor of the file, open for writing.
void write_atomically(const std::filesystem::path& path, const std::function<void(int)>& writer);

/// The same for contents that are at hand.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

/// The whole file. @throws IoError
std::string read_file(const std::filesystem::path& path);

/// The folder and those above it; no error if it is there. @throws IoError
void make_folder(const std::filesystem::path& path);

/// Writes all bytes to a file descriptor, however many calls that takes.
/// @throws IoError with `path` and the reason
void write_all(int descriptor, std::string_view contents, const std::filesystem::path& path);

/// The same from a byte of the file on; what is between its end and that byte becomes zeros.
void write_all_at(int descriptor, std::string_view contents, std::size_t offset, const std::filesystem::path& path);

}  // namespace gneiss
