#include "io/output/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// A file descriptor that closes itself. Errors of close() matter to writers: they call close_checked().
class Descriptor {
public:
    /// `shown` is the name that messages speak of: the user never asked for a ".part".
    Descriptor(const fs::path& path, int flags, fs::path shown)
        : shown_(std::move(shown)), number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        if (number_ < 0) throw io_error_from_errno(shown_, "cannot open");
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }

    int number() const { return number_; }

    void sync() const {
        // EINVAL, ENOTSUP, EROFS: this kind of file cannot be forced to the disk, which is no failure to write it.
        if (::fsync(number_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
            throw io_error_from_errno(shown_, "cannot force to the disk");
    }

    void close_checked() {
        const int number = number_;
        number_ = -1;
        if (::close(number) != 0) throw io_error_from_errno(shown_, "cannot close");
    }

private:
    fs::path shown_;
    int number_;
};

void sync_and_rename(const fs::path& part, const fs::path& path) {
    {
        Descriptor file(part, O_RDONLY, path);
        file.sync();
    }
    if (::rename(part.c_str(), path.c_str()) != 0) throw io_error_from_errno(path, "cannot rename the finished file");
    // The new name survives a power cut only once its folder is on the disk too.
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    Descriptor(folder, O_RDONLY | O_DIRECTORY, folder).sync();
}

}  // namespace

IoError::IoError(fs::path path, const std::string& reason)
    : std::runtime_error(path.string() + ": " + reason), path_(std::move(path)) {}

IoError io_error_from_errno(const fs::path& path, std::string_view what_failed) {
    const int code = errno;
    return {path, std::string(what_failed) + ": " + std::generic_category().message(code)};
}

fs::path part_path(const fs::path& path) {
    fs::path part = path;
    part += ".part";
    return part;
}

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& writer) {
    const fs::path part = part_path(path);
    try {
        writer(part);
        sync_and_rename(part, path);
    } catch (...) {
        std::error_code ignored;  // the first error is the one to report
        fs::remove(part, ignored);
        throw;
    }
}

void write_atomically(const fs::path& path, const std::function<void(int)>& writer) {
    write_atomically(path, [&](const fs::path& part) {
        Descriptor file(part, O_WRONLY | O_CREAT | O_TRUNC, path);
        writer(file.number());
        file.close_checked();
    });
}

void write_atomically(const fs::path& path, std::string_view contents) {
    write_atomically(path, [&](int file) { write_all(file, contents, path); });
}

std::string read_file(const fs::path& path) {
    const Descriptor file(path, O_RDONLY, path);
    std::string contents;
    char buffer[1 << 16];
    for (;;) {
        const ssize_t n = ::read(file.number(), buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw io_error_from_errno(path, "cannot read");
        if (n == 0) return contents;
        contents.append(buffer, static_cast<std::size_t>(n));
    }
}

void make_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw IoError(path, "cannot make the folder: " + error.message());
}

void write_all(int descriptor, std::string_view contents, const fs::path& path) {
    while (!contents.empty()) {
        const ssize_t n = ::write(descriptor, contents.data(), contents.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw io_error_from_errno(path, "cannot write");
        contents.remove_prefix(static_cast<std::size_t>(n));
    }
}

void write_all_at(int descriptor, std::string_view contents, std::size_t offset, const fs::path& path) {
    if (::lseek(descriptor, static_cast<off_t>(offset), SEEK_SET) < 0) throw io_error_from_errno(path, "cannot write");
    write_all(descriptor, contents, path);
}

}  // namespace gneiss
