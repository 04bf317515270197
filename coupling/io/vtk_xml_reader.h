// VTK's XML poly data (.vtp; also .vtu, whose points are written alike), after the XML file formats of the
// VTK User's Guide: DataArrays as text, base64 or appended (raw or base64), plain or compressed by
// vtkZLibDataCompressor, of either byte order, with 32- or 64-bit headers. Read are the points of one Piece
// and their PointData, of which a radius or a diameter must be there. One frame a file; its time is the
// FieldData array TimeValue, where there is one.
#pragma once

#include <memory>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

std::unique_ptr<ParticleReader> open_vtk_xml(const std::filesystem::path& path, const ReaderOptions& options);

}  // namespace interstice::io
