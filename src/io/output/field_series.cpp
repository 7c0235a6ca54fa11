#include "io/output/field_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <system_error>

#include "io/output/atomic_file.hpp"

namespace gneiss {

namespace fs = std::filesystem;

FieldSeries::FieldSeries(fs::path folder, const FieldMesh& mesh, std::optional<double> restart_time, std::string name,
                         VtuData data)
    : folder_(std::move(folder)), name_(std::move(name)), writer_(mesh, data) {
    if (restart_time && fs::exists(index_path())) continue_from(*restart_time);
    // The list goes first: at no moment may it name a frame that is gone.
    if (fs::exists(index_path())) write_pvd(index_path(), frames_);
    remove_unlisted_frames();
}

void FieldSeries::write(double t, std::int64_t step, const Fields& fields) {
    if (!(frames_.empty() || t >= frames_.back().t))
        throw std::invalid_argument(fmt::format("FieldSeries: frame at t = {} after one at {}", t, frames_.back().t));
    const bool replaces = !frames_.empty() && frames_.back().t == t;
    const std::size_t number = replaces ? frames_.size() - 1 : frames_.size();
    const std::string file = fmt::format("{}_{:06}.vtu", name_, number);
    writer_.write(folder_ / file, t, step, fields);
    if (replaces) return;
    frames_.push_back({t, file});
    write_pvd(index_path(), frames_);
}

std::optional<double> FieldSeries::last_time() const {
    if (frames_.empty()) return {};
    return frames_.back().t;
}

bool FieldSeries::is_frame_name(const std::string& file) const {
    const std::string prefix = name_ + "_", suffix = ".vtu";
    if (!(file.size() > prefix.size() + suffix.size() && file.starts_with(prefix) && file.ends_with(suffix)))
        return false;
    return std::all_of(file.begin() + static_cast<std::ptrdiff_t>(prefix.size()),
                       file.end() - static_cast<std::ptrdiff_t>(suffix.size()),
                       [](char c) { return c >= '0' && c <= '9'; });
}

void FieldSeries::continue_from(double restart_time) {
    frames_ = read_pvd(index_path());
    // Times were written exactly, so the frame of the restart time itself stays.
    std::erase_if(frames_, [&](const PvdFrame& frame) { return frame.t > restart_time; });
}

void FieldSeries::remove_unlisted_frames() const {
    std::set<std::string> listed;
    for (const PvdFrame& frame : frames_) listed.insert(frame.file);

    std::error_code error;
    std::vector<fs::path> unlisted;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
        const std::string file = entry.path().filename().string();
        if (is_frame_name(file) && !listed.contains(file)) unlisted.push_back(entry.path());
    }
    if (error) throw IoError(folder_, "cannot list the folder: " + error.message());
    for (const fs::path& path : unlisted) {
        fs::remove(path, error);
        if (error) throw IoError(path, "cannot remove the old frame: " + error.message());
    }
}

}  // namespace gneiss
