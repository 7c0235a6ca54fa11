#pragma once
// HDF5's C interface with closing handles and exceptions. Included by checkpoint.cpp alone.

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace gneiss::hdf5 {

/// What the library says about a call that failed: the innermost description on its error stack.
class Error : public std::runtime_error {
public:
    explicit Error(const char* what_failed) : std::runtime_error(std::string(what_failed) + innermost()) {}

private:
    static std::string innermost() {
        std::string text;
        const auto keep_first = [](unsigned, const H5E_error2_t* error, void* result) -> herr_t {
            auto& description = *static_cast<std::string*>(result);
            if (description.empty() && error->desc) description = std::string(": ") + error->desc;
            return 0;
        };
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
        return text;
    }
};

/// While it lives the library prints no error stack; failures are told by exceptions.
class Silence {
public:
    Silence() {
        H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    H5E_auto2_t function_ = nullptr;
    void* data_ = nullptr;
};

/// An identifier that closes itself with the function of its kind.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t), const char* what_failed) : id_(id), close_(close) {
        if (id_ < 0) throw Error(what_failed);
    }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }

    operator hid_t() const { return id_; }  // NOLINT: the C functions take it

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// Passes a result through. @throws Error if it is negative
template <class T>
T checked(T result, const char* what_failed) {
    if (result < 0) throw Error(what_failed);
    return result;
}

}  // namespace gneiss::hdf5
