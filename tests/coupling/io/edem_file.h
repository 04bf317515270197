// EDEM's HDF5 results by their published layout, written for a test.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "coupling/io/hdf5_handles.h"

namespace interstice::io::testing {

/// An EDEM file of two types of particle in one time step, as the reader's header describes it.
struct EdemFile {
  std::filesystem::path path;
  Hdf5Handle file;

  explicit EdemFile(const std::filesystem::path& where) : path(where) {
    file = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "creating");
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "links");
    H5Pset_create_intermediate_group(links, 1);
    for (const char* name : {"/CreatorData/0/ParticleTypes/0/Spheres", "/CreatorData/0/ParticleTypes/1",
                             "/TimestepData/7/ParticleTypes/0", "/TimestepData/7/ParticleTypes/1"}) {
      Hdf5Handle(H5Gcreate2(file, name, links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
    }
  }
  void table(const char* name, const std::vector<double>& values, hsize_t columns, hid_t type) {
    const std::array<hsize_t, 2> size{values.size() / columns, columns};
    const Hdf5Handle space(H5Screate_simple(columns > 1 ? 2 : 1, size.data(), nullptr), H5Sclose, "space");
    const Hdf5Handle set(H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                         name);
    checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  }
  void attribute(const char* group, const char* name, double value) {
    const Hdf5Handle object(H5Gopen2(file, group, H5P_DEFAULT), H5Gclose, group);
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value, 1);
  }
  void fill(bool radii, double scale) {
    attribute("/TimestepData/7", "time", 0.125);
    if (radii) attribute("/CreatorData/0/ParticleTypes/0/Spheres", "rawRadius", 0.01);
    attribute("/CreatorData/0/ParticleTypes/1", "physicalRadius", 0.02);
    table("/TimestepData/7/ParticleTypes/0/position", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, 3, H5T_IEEE_F64LE);
    table("/TimestepData/7/ParticleTypes/0/ids", {3, 1}, 1, H5T_STD_I32LE);
    table("/TimestepData/7/ParticleTypes/0/scale", {scale, 0.5}, 1, H5T_IEEE_F64LE);
    table("/TimestepData/7/ParticleTypes/0/velocity", {1, 2, 3, 4, 5, 6}, 3, H5T_IEEE_F64LE);
    table("/TimestepData/7/ParticleTypes/1/position", {0.7, 0.8, 0.9}, 3, H5T_IEEE_F32LE);
    table("/TimestepData/7/ParticleTypes/1/ids", {2}, 1, H5T_STD_I64LE);
    table("/TimestepData/7/ParticleTypes/1/scale", {1}, 1, H5T_IEEE_F64LE);
    table("/TimestepData/7/ParticleTypes/1/velocity", {7, 8, 9}, 3, H5T_IEEE_F64LE);
    file.close("closing");
  }
};

}  // namespace interstice::io::testing
