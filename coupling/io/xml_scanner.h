// The part of XML that VTK's files use, read as a stream: tags with attributes, text between them, comments.
//
// Of our own because a tree (Boost.PropertyTree) would hold an inline array of gigabytes as text, several
// times over, and because an AppendedData section with raw bytes is no XML at all: no general parser gets
// past it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupling/io/text_lines.h"

namespace interstice::io {

class XmlScanner {
 public:
  explicit XmlScanner(const std::filesystem::path& path);

  enum class Tag { open, close, none };  // none: the end of the document
  /// Passes over text to the next tag; <a/> comes as open, then close. Throws InputError where the text is no
  /// XML of this kind: tags that do not match, a document that ends early, DOCTYPE, CDATA.
  Tag next();
  /// Name and attributes of the last tag.
  const std::string& name() const { return name_; }
  const std::string* attribute(const std::string& name) const;
  /// Has the last tag, an open one, content that get() can read? False for <a/>.
  bool has_content() const { return !closes_itself_; }
  /// Passes over all up to the close of the element just opened.
  void skip_element();

  /// Content, byte by byte: the next byte (-1: the end of the file), and without taking it.
  int get();
  int peek();
  std::size_t read(char* to, std::size_t count);

  std::string where() const;
  const std::filesystem::path& path() const { return bytes_.path(); }
  /// Why the file ended early; empty where it merely ended.
  const std::string& damage() const { return bytes_.damage(); }
  [[noreturn]] void wrong(const std::string& what) const;

 private:
  bool fill();
  Tag open_tag();
  Tag close_tag();
  void pass_until(const char* end);
  void skip_blanks();
  int need();
  std::string word();
  std::string quoted();

  TextLines bytes_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::int64_t line_ = 1;
  std::string name_;
  std::map<std::string, std::string> attributes_;
  std::vector<std::string> open_;
  bool closes_itself_ = false;
};

}  // namespace interstice::io
