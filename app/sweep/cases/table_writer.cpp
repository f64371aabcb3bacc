#include "app/sweep/cases/table_writer.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <limits>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

// of the first failure, before others fail for reasons of theirs
void note(const std::ofstream& out, int& reason)
{
  reason = out || reason != 0 ? reason : errno;
}

void finishFile(std::ofstream& out, const fs::path& file)
{
  const int before = errno;
  if (!out.flush())
  {
    refuseFile(file, before != 0 ? before : errno != 0 ? errno : EIO);
  }
}

class CsvWriter : public TableWriter
{
public:
  CsvWriter(const fs::path& file, const std::vector<WrittenColumn>& columns)
    : file_(file)
    , out_(file)
  {
    std::vector<std::string> titles;
    titles.reserve(columns.size());
    for (const WrittenColumn& column : columns)
    {
      titles.push_back(column.title);
    }
    CsvWriter::add(titles);
  }

  bool add(const std::vector<std::string>& cells) override
  {
    const char* separator = "";
    for (const std::string& cell : cells)
    {
      out_ << separator << csvField(cell);
      separator = ",";
    }
    out_ << '\n';
    note(out_, reason_);
    return true;
  }

  void finish() override
  {
    errno = reason_;
    finishFile(out_, file_);
  }

private:
  fs::path file_;
  std::ofstream out_;
  int reason_ = 0;
};

std::string escaped(const std::string& text)
{
  std::string safe;
  for (const char c : text)
  {
    safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return safe;
}

class VtkWriter : public TableWriter
{
public:
  VtkWriter(const fs::path& file, const std::vector<WrittenColumn>& columns)
    : file_(file)
    , columns_(columns)
  {
    for (std::size_t i = 0; i < columns_.size(); ++i)
    {
      spools_.emplace_back(spool(i), std::ios::binary);
    }
  }

  bool add(const std::vector<std::string>& cells) override
  {
    ++rows_;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      const std::string& cell = cells[i];
      if (!columns_[i].isNumber)
      {
        spools_[i].write(cell.c_str(), static_cast<std::streamsize>(cell.size() + 1));
        note(spools_[i], reason_);
        continue;
      }
      const std::optional<double> value = numberOf(cell);
      if (!value)
      {
        return false;
      }
      spools_[i].write(reinterpret_cast<const char*>(&*value), sizeof *value);
      note(spools_[i], reason_);
    }
    return true;
  }

  void finish() override
  {
    std::ofstream out(file_, std::ios::binary);
    out << R"(<VTKFile type="Table" version="1.0" byte_order=")"
        << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
        << R"(" header_type="UInt64"><Table><Piece NumberOfCols=")" << columns_.size()
        << R"(" NumberOfRows=")" << rows_ << R"("><RowData>)";
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i)
    {
      errno = reason_;
      finishFile(spools_[i], file_);
      out << R"(<)" << (columns_[i].isNumber ? "DataArray" : "Array") << R"( type=")"
          << (columns_[i].isNumber ? "Float64" : "String") << R"(" Name=")"
          << escaped(columns_[i].title) << R"(" format="appended" offset=")" << offset << R"("/>)";
      offset += sizeof offset + fs::file_size(spool(i));
    }
    out << R"(</RowData></Piece></Table><AppendedData encoding="raw">_)";
    for (std::size_t i = 0; i < columns_.size(); ++i)
    {
      const std::uint64_t size = fs::file_size(spool(i));
      out.write(reinterpret_cast<const char*>(&size), sizeof size);
      if (size > 0) // else it would count as a failure
      {
        out << std::ifstream(spool(i), std::ios::binary).rdbuf();
        note(out, reason_);
      }
    }
    out << "</AppendedData></VTKFile>\n";
    errno = reason_;
    finishFile(out, file_);
  }

private:
  [[nodiscard]] fs::path spool(std::size_t column) const
  {
    return file_.parent_path() / ("column" + std::to_string(column));
  }

  fs::path file_;
  std::vector<WrittenColumn> columns_;
  int reason_ = 0;
  std::vector<std::ofstream> spools_;
  std::size_t rows_ = 0;
};

} // namespace

std::optional<double> numberOf(const std::string& cell)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  const char* end = cell.data() + cell.size();
  return std::from_chars(cell.data(), end, value).ptr == end ? std::optional(value) : std::nullopt;
}

std::unique_ptr<TableWriter> makeCsvWriter(
  const fs::path& file, const std::vector<WrittenColumn>& columns)
{
  return std::make_unique<CsvWriter>(file, columns);
}

std::unique_ptr<TableWriter> makeVtkWriter(
  const fs::path& file, const std::vector<WrittenColumn>& columns)
{
  return std::make_unique<VtkWriter>(file, columns);
}

} // namespace palp
