#include "io/output/pvd_index.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"

namespace gneiss {
namespace {

/// The value of ` NAME="VALUE"` in a tag.
std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
    const std::string before = fmt::format(" {}=\"", name);
    const std::size_t found = tag.find(before);
    if (found == tag.npos) return {};
    const std::size_t first = found + before.size(), end = tag.find('"', first);
    if (end == tag.npos) return {};
    return tag.substr(first, end - first);
}

std::optional<PvdFrame> frame_of(std::string_view tag) {
    const auto time = attribute(tag, "timestep"), file = attribute(tag, "file");
    PvdFrame frame{};
    if (!time || !file || std::from_chars(time->data(), time->data() + time->size(), frame.t).ec != std::errc())
        return {};
    frame.file = *file;
    return frame;
}

}  // namespace

void write_pvd(const std::filesystem::path& path, const std::vector<PvdFrame>& frames) {
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (const PvdFrame& frame : frames)
        text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.t, frame.file);
    text += "  </Collection>\n</VTKFile>\n";
    write_atomically(path, text);
}

std::vector<PvdFrame> read_pvd(const std::filesystem::path& path) {
    const std::string text = read_file(path);
    const std::string_view all = text, opening = "<Collection>", entry = "<DataSet";
    const std::size_t begin = all.find(opening), end = all.find("</Collection>");
    if (begin == all.npos || end == all.npos || end < begin)
        throw InputError(path.string(), "is no list of frames (.pvd): it has no Collection");

    std::vector<PvdFrame> frames;
    std::string_view rest = all.substr(begin + opening.size(), end - begin - opening.size());
    for (std::size_t at = rest.find(entry); at != rest.npos; at = rest.find(entry)) {
        rest.remove_prefix(at + entry.size());
        const auto frame = frame_of(rest.substr(0, rest.find('>')));
        if (!frame)
            throw InputError(path.string(), fmt::format("entry {} lacks a timestep or a file", frames.size() + 1));
        frames.push_back(*frame);
    }
    return frames;
}

}  // namespace gneiss
