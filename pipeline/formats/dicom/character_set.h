#pragma once

#include <string>
#include <string_view>

namespace palp
{

/// Text of DICOM in UTF-8.
///
/// What is valid UTF-8 is taken for it, whatever is declared, but where that says GB18030 or GBK;
/// what nothing is declared for, or what is not of the declared set, is taken for ISO 8859-1.
///
/// @param characterSet  Specific Character Set (0008,0005): terms between backslashes, those of ISO
///                      2022 with what their escape sequences switch to; empty: none
/// @source DICOM PS3.3 C.12.1.1.2, PS3.5 6.1 and annexes H to K
[[nodiscard]] std::string inUtf8(std::string_view text, std::string_view characterSet);

} // namespace palp
