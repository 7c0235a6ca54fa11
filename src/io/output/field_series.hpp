#pragma once
// The fields of a run against time: fields_000000.vtu, fields_000001.vtu, … and fields.pvd, which lists them.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/output/pvd_index.hpp"
#include "io/output/vtu_writer.hpp"

namespace gneiss {

/// Numbers and writes the frames of one run. After every frame the list is written anew, so that an unfinished run can
/// be looked at. Every file appears whole or not at all.
class FieldSeries {
public:
    /// Begins the series NAME.pvd in `folder`, which exists. Frames of an older series of that name are removed.
    /// @param restart_time  s; goes on with the series that is there instead: frames later than this are removed
    /// @throws InputError if the list to go on with cannot be understood
    /// @throws IoError if an old frame cannot be removed
    /// @throws std::invalid_argument as VtuWriter
    FieldSeries(std::filesystem::path folder, const FieldMesh& mesh, std::optional<double> restart_time = {},
                std::string name = "fields", VtuData data = VtuData::raw);

    /// Writes one frame and the list. A frame at the time of the last one takes its place.
    /// @param t  s, not before the last frame
    /// @throws IoError, std::invalid_argument
    void write(double t, std::int64_t step, const Fields& fields);

    /// From here on the frames have this mesh: after nodes were split, say.
    void set_mesh(const FieldMesh& mesh) { writer_ = VtuWriter(mesh, writer_.data()); }

    std::size_t n_frames() const { return frames_.size(); }

    /// Time of the last frame, s.
    std::optional<double> last_time() const;

private:
    std::filesystem::path index_path() const { return folder_ / (name_ + ".pvd"); }
    bool is_frame_name(const std::string& file) const;
    void continue_from(double restart_time);
    void remove_unlisted_frames() const;

    std::filesystem::path folder_;
    std::string name_;
    VtuWriter writer_;
    std::vector<PvdFrame> frames_;
};

}  // namespace gneiss
