#include "io/output/vtu_writer.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "io/output/atomic_file.hpp"
#include "io/output/vtk_messages.hpp"

namespace gneiss {
namespace {

// A frame of doubles shrinks little further at higher levels, which take several times as long.
constexpr int zlib_level = 1;

vtkNew<vtkPoints> points_of(const FieldMesh& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i][0], mesh.points[i][1], 0.0);
    return points;
}

template <std::size_t n>
vtkNew<vtkCellArray> cells_of(std::span<const std::array<std::int32_t, n>> numbers, std::size_t n_given,
                              const char* cell) {
    const auto n_points = static_cast<std::int64_t>(n_given);
    vtkNew<vtkTypeInt32Array> connectivity;
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(n * numbers.size()));
    vtkIdType k = 0;
    for (std::size_t e = 0; e < numbers.size(); ++e) {
        for (const std::int32_t point : numbers[e]) {
            if (!(point >= 0 && point < n_points))
                throw std::invalid_argument(
                    fmt::format("VtuWriter: {} {} names point {}, allowed: 0 to {}", cell, e, point, n_points - 1));
            connectivity->SetValue(k++, point);
        }
    }
    vtkNew<vtkTypeInt32Array> offsets;
    offsets->SetNumberOfValues(static_cast<vtkIdType>(numbers.size() + 1));
    for (vtkIdType e = 0; e < offsets->GetNumberOfValues(); ++e)
        offsets->SetValue(e, static_cast<std::int32_t>(n * static_cast<std::size_t>(e)));

    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, connectivity);
    return cells;
}

void check(const FieldArray& field, vtkIdType n_rows) {
    const auto n_names = field.component_names.size();
    if (field.n_components < 1) throw std::invalid_argument("field " + field.name + ": needs a component");
    if (n_names != 0 && n_names != static_cast<std::size_t>(field.n_components))
        throw std::invalid_argument(
            fmt::format("field {}: {} components, but {} names for them", field.name, field.n_components, n_names));
    if (field.values.size() != static_cast<std::size_t>(n_rows) * static_cast<std::size_t>(field.n_components))
        throw std::invalid_argument(fmt::format("field {}: {} numbers for {} rows of {} components", field.name,
                                                field.values.size(), n_rows, field.n_components));
}

vtkNew<vtkDoubleArray> vtk_array(const FieldArray& field, vtkIdType n_rows) {
    check(field, n_rows);
    vtkNew<vtkDoubleArray> array;
    array->SetName(field.name.c_str());
    if (field.n_components == 2 && field.component_names.empty()) {
        // Readers take three components, and only those, for a vector (arrows, warping).
        array->SetNumberOfComponents(3);
        array->SetNumberOfTuples(n_rows);
        double* row = array->GetPointer(0);
        for (std::size_t i = 0; i < field.values.size(); i += 2, row += 3) {
            row[0] = field.values[i];
            row[1] = field.values[i + 1];
            row[2] = 0.0;
        }
        return array;
    }
    array->SetNumberOfComponents(field.n_components);
    for (int k = 0; k < static_cast<int>(field.component_names.size()); ++k)
        array->SetComponentName(k, field.component_names[static_cast<std::size_t>(k)].c_str());
    // VTK only reads it; 1: the memory stays ours.
    array->SetArray(const_cast<double*>(field.values.data()), static_cast<vtkIdType>(field.values.size()), 1);
    return array;
}

void add_fields(const std::vector<FieldArray>& fields, vtkIdType n_rows, vtkDataSetAttributes* target) {
    for (const FieldArray& field : fields) {
        if (field.name.empty() || target->HasArray(field.name.c_str()))
            throw std::invalid_argument("field '" + field.name + "': every array needs a name of its own");
        target->AddArray(vtk_array(field, n_rows));
    }
}

void write_file(vtkUnstructuredGrid* grid, const std::filesystem::path& part, const std::filesystem::path& path) {
    VtkMessages messages;
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    messages.listen_to(writer);
    messages.listen_to(writer->GetExecutive());
    writer->SetInputData(grid);
    writer->SetFileName(part.c_str());
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(zlib_level);
    writer->SetHeaderTypeToUInt64();  // arrays of 4 GiB and more
    const bool written = writer->Write() != 0;
    const unsigned long code = writer->GetErrorCode();
    if (!written || code != vtkErrorCode::NoError || !messages.text().empty()) {
        std::string reason =
            code != vtkErrorCode::NoError ? vtkErrorCode::GetStringFromErrorCode(code) : messages.text();
        throw IoError(path, "cannot write: " + (reason.empty() ? "VTK gives no reason" : reason));
    }
}

}  // namespace

struct VtuWriter::Grid {
    vtkNew<vtkUnstructuredGrid> data;
};

VtuWriter::VtuWriter(const FieldMesh& mesh) : grid_(std::make_unique<Grid>()) {
    grid_->data->SetPoints(points_of(mesh));
    const bool of_lines = mesh.triangles.empty();
    if (of_lines)
        grid_->data->SetCells(VTK_LINE, cells_of(mesh.lines, mesh.points.size(), "line"));
    else
        grid_->data->SetCells(VTK_TRIANGLE, cells_of(mesh.triangles, mesh.points.size(), "triangle"));
    const std::size_t n_cells = of_lines ? mesh.lines.size() : mesh.triangles.size();
    for (const IntegerArray& integers : mesh.integers) {
        if (integers.values.size() != n_cells)
            throw std::invalid_argument(fmt::format("field {}: {} numbers for {} {}", integers.name,
                                                    integers.values.size(), n_cells, of_lines ? "lines" : "triangles"));
        vtkNew<vtkTypeInt32Array> array;
        array->SetName(integers.name.c_str());
        array->SetNumberOfValues(static_cast<vtkIdType>(integers.values.size()));
        std::copy(integers.values.begin(), integers.values.end(), array->GetPointer(0));
        grid_->data->GetCellData()->AddArray(array);
    }
}

VtuWriter::~VtuWriter() = default;
VtuWriter::VtuWriter(VtuWriter&&) noexcept = default;
VtuWriter& VtuWriter::operator=(VtuWriter&&) noexcept = default;

void VtuWriter::write(const std::filesystem::path& path, double t, std::int64_t step, const Fields& fields) const {
    vtkNew<vtkUnstructuredGrid> frame;
    frame->ShallowCopy(grid_->data);
    add_fields(fields.points, frame->GetNumberOfPoints(), frame->GetPointData());
    add_fields(fields.cells, frame->GetNumberOfCells(), frame->GetCellData());

    vtkNew<vtkDoubleArray> time;
    time->SetName("TimeValue");
    time->InsertNextValue(t);
    frame->GetFieldData()->AddArray(time);
    vtkNew<vtkTypeInt64Array> steps;
    steps->SetName("step");
    steps->InsertNextValue(step);
    frame->GetFieldData()->AddArray(steps);

    write_atomically(path, [&](const std::filesystem::path& part) { write_file(frame, part, path); });
}

}  // namespace gneiss
