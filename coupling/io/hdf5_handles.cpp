#include "coupling/io/hdf5_handles.h"

#include <algorithm>

namespace interstice::io {

namespace {

std::recursive_mutex& library_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 1;  // the walk goes from the innermost call outwards: the first entry is the reason
}

}  // namespace

Hdf5Session::Hdf5Session() : lock_(library_mutex()) {
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Session::~Hdf5Session() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }

void throw_hdf5_error(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw Hdf5Error(what + " failed" + (reason.empty() ? "" : ": " + reason));
}

Hdf5Handle oldest_format_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "preparing file access");
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), "choosing the file format");
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "preparing file access");
  return access;
}

Hdf5Handle simple_space(hsize_t elements) {
  return Hdf5Handle(H5Screate_simple(1, &elements, nullptr), H5Sclose, "describing an array");
}

Hdf5Handle text_type(std::size_t bytes) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describing a text");
  checked(H5Tset_size(type, std::max<std::size_t>(bytes, 1)), "describing a text");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "describing a text");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "describing a text");
  return type;
}

void write_text_attribute(hid_t object, const char* name, const std::string& text) {
  const Hdf5Handle type = text_type(text.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describing a text");
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "creating an attribute");
  checked(H5Awrite(attribute, type, text.c_str()), "writing an attribute");
}

std::string read_text_attribute(hid_t object, const char* name) {
  if (checked(H5Aexists(object, name), "looking for an attribute") == 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "opening an attribute");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "reading an attribute's type");
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "reading an attribute's size");
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return {};
  if (H5Sget_simple_extent_npoints(space) != 1) return {};
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, text.data()), "reading an attribute");
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

void write_attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type, const void* values,
                     hsize_t count) {
  const Hdf5Handle space = simple_space(count);
  const Hdf5Handle attribute(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "creating an attribute");
  checked(H5Awrite(attribute, memory_type, values), "writing an attribute");
}

bool read_attribute(hid_t object, const char* name, hid_t memory_type, void* values, hsize_t count) {
  if (checked(H5Aexists(object, name), "looking for an attribute") == 0) return false;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "opening an attribute");
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, "reading an attribute's size");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "reading an attribute's type");
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return false;
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(count)) return false;
  checked(H5Aread(attribute, memory_type, values), "reading an attribute");
  return true;
}

}  // namespace interstice::io
