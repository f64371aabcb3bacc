#include "pipeline/formats/dicom/dicom_values.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/dicom/character_set.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>
#include <sstream>
#include <string_view>

namespace palp
{
namespace
{

std::ostringstream& warnings()
{
  static std::ostringstream kept; // by GDCM, for as long as the program runs
  return kept;
}

// The decoder of JPEG tells the error stream alone that data are damaged, and goes on: this takes
// the place of that.
class HeardErrors
{
public:
  HeardErrors()
    : stream_(open_memstream(&text_, &size_))
  {
    stderr = stream_ != nullptr ? stream_ : stderr;
  }

  void forget()
  {
    (void)all();
    known_ = size_;
  }

  [[nodiscard]] std::string_view all()
  {
    stream_ != nullptr ? fflush(stream_) : 0;
    return stream_ != nullptr ? std::string_view(text_, size_).substr(known_) : std::string_view();
  }

private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::size_t known_ = 0; // before this file
  FILE* stream_;
};

HeardErrors& errors()
{
  static HeardErrors kept;
  return kept;
}

} // namespace

std::string textOf(const gdcm::DataSet& data, const gdcm::Tag& tag, std::string_view characterSet)
{
  const gdcm::ByteValue* bytes =
    data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
  std::string text =
    bytes != nullptr ? std::string(bytes->GetPointer(), bytes->GetLength()) : std::string();
  std::erase(text, '\0');
  return inUtf8(trimmed(text), characterSet);
}

std::optional<std::vector<double>> decimalsOf(
  const gdcm::DataSet& data, const gdcm::Tag& tag, std::size_t count)
{
  std::vector<double> numbers;
  const std::string text = textOf(data, tag);
  for (const std::string_view word : split(text, '\\'))
  {
    const std::optional<double> number = csvNumber(word);
    if (!number || !std::isfinite(*number))
    {
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

double decimalOf(const gdcm::DataSet& data, const gdcm::Tag& tag, double usual)
{
  const auto number = decimalsOf(data, tag, 1);
  return number ? number->front() : usual;
}

int countOf(const gdcm::DataSet& data, const gdcm::Tag& tag)
{
  const gdcm::ByteValue* bytes =
    data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
  std::uint16_t count = 0;
  if (bytes != nullptr && bytes->GetLength() >= sizeof count)
  {
    std::memcpy(&count, bytes->GetPointer(), sizeof count);
  }
  return count;
}

std::vector<gdcm::DataSet> itemsOf(const gdcm::DataSet& data, const gdcm::Tag& tag)
{
  std::vector<gdcm::DataSet> items;
  if (!data.FindDataElement(tag))
  {
    return items;
  }
  const auto sequence = data.GetDataElement(tag).GetValueAsSQ();
  for (std::size_t i = 1; sequence && i <= sequence->GetNumberOfItems(); ++i)
  {
    items.push_back(sequence->GetItem(i).GetNestedDataSet());
  }
  return items;
}

gdcm::DataSet groupOf(const gdcm::DataSet& groups, const gdcm::Tag& tag)
{
  const std::vector<gdcm::DataSet> items = itemsOf(groups, tag);
  return items.size() == 1 ? items.front() : gdcm::DataSet();
}

void listenToGdcm()
{
  warnings().str("");
  errors().forget();
  gdcm::Trace::SetDebug(false);
  gdcm::Trace::SetError(false);
  gdcm::Trace::SetWarningStream(warnings());
  gdcm::Trace::SetWarning(true);
}

bool wasFilledUp()
{
  return warnings().str().find("own risk") != std::string::npos;
}

bool isDamagedJpeg()
{
  return errors().all().find("Corrupt JPEG data") != std::string_view::npos;
}

bool readWhole(gdcm::Reader& reader, const std::filesystem::path& file)
{
  listenToGdcm();
  reader.SetFileName(file.c_str());
  return reader.Read() && !wasFilledUp();
}

void placeInPatient(
  PatientImage& image, const std::array<Eigen::Vector3d, 3>& along, const Eigen::Vector3d& first)
{
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> form(image.toPatient);
  form.setIdentity();
  for (int k = 0; k < 3; ++k)
  {
    form.col(k).head<3>() = along[static_cast<std::size_t>(k)];
  }
  form.col(3).head<3>() = first;
  image.unit = "mm";
  image.space = "LPS";
  image.notes.emplace_back("in the patient's axes to left, back and head (LPS)");
}

} // namespace palp
