// Legacy VTK files ("# vtk DataFile Version 1.0" to 5.1), after the file format chapter of the VTK User's
// Guide and, for the OFFSETS/CONNECTIVITY of 5.1 and METADATA, VTK's vtkDataWriter: ASCII and BINARY
// (big-endian), DATASET POLYDATA or UNSTRUCTURED_GRID. So write LIGGGHTS (dump custom/vtk), pizza.py's
// dump2vtk, lpp and ParaView. Cells are passed over; what is read are POINTS and the arrays of POINT_DATA.
// One frame a file; its time is the FIELD array TIME (or TimeValue), its step CYCLE, where they are there.
#pragma once

#include <memory>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

std::unique_ptr<ParticleReader> open_vtk_legacy(const std::filesystem::path& path,
                                                const ReaderOptions& options);

}  // namespace interstice::io
