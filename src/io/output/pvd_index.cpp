#include "io/output/pvd_index.hpp"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <charconv>
#include <cstring>
#include <sstream>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/vtk_messages.hpp"

namespace gneiss {

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
    std::istringstream stream(read_file(path));
    VtkMessages messages;
    vtkNew<vtkXMLDataParser> parser;
    messages.listen_to(parser);
    parser->SetStream(&stream);
    const bool parsed = parser->Parse() != 0;
    vtkXMLDataElement* root = parsed ? parser->GetRootElement() : nullptr;
    vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!collection) throw InputError(path.string(), "is no list of frames (.pvd): it has no Collection");

    std::vector<PvdFrame> frames;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* entry = collection->GetNestedElement(i);
        const char* time = entry->GetAttribute("timestep");
        const char* file = entry->GetAttribute("file");
        PvdFrame frame{};
        if (!time || !file || std::from_chars(time, time + std::strlen(time), frame.t).ec != std::errc())
            throw InputError(path.string(), fmt::format("entry {} lacks a timestep or a file", i + 1));
        frame.file = file;
        frames.push_back(std::move(frame));
    }
    return frames;
}

}  // namespace gneiss
