// Owners for what the HDF5 C library hands out, its errors as exceptions, and the one lock that guards it.
//
// The serial HDF5 library is not promised to be thread-safe, so every function of this folder that calls it
// holds an Hdf5Session for as long as it does. Callers should still use these files from one thread at a
// time: the lock makes a mistake slow, not fast.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace interstice::io {

/// A failed HDF5 call; caught inside this folder and rethrown as RunError (writing) or InputError (reading).
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds the library for one thread and keeps it from printing its errors while it does.
class Hdf5Session {
 public:
  Hdf5Session();
  ~Hdf5Session();
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

/// Throws Hdf5Error("`what` failed: the library's innermost reason").
[[noreturn]] void throw_hdf5_error(const std::string& what);

/// `result` of an HDF5 call, or Hdf5Error when it is negative.
template <class Result>
Result checked(Result result, const char* what) {
  if (result < 0) throw_hdf5_error(what);
  return result;
}

/// An identifier with the function that closes it.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close closer, const char* what) : id_(checked(id, what)), close_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }

  hid_t get() const { return id_; }
  operator hid_t() const { return id_; }

  /// Closes now: for files, whose last writes (and failures) happen here.
  void close(const char* what) {
    if (const hid_t id = std::exchange(id_, -1); id >= 0) checked(close_(id), what);
  }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// File access in the oldest format (superblock 0), which every HDF5 since 1.6 reads and which has no "open
/// for writing" mark that a killed process would leave behind.
Hdf5Handle oldest_format_access();

Hdf5Handle simple_space(hsize_t elements);
/// A text type of `bytes` bytes (at least 1), UTF-8, padded with zeros.
Hdf5Handle text_type(std::size_t bytes);

void write_text_attribute(hid_t object, const char* name, const std::string& text);
/// The attribute's text, or "" where there is none or it is no fixed-length text.
std::string read_text_attribute(hid_t object, const char* name);
/// One number, or several (a 1-D attribute).
void write_attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type, const void* values,
                     hsize_t count);
/// False where there is no such attribute of `count` numbers.
bool read_attribute(hid_t object, const char* name, hid_t memory_type, void* values, hsize_t count);

}  // namespace interstice::io
