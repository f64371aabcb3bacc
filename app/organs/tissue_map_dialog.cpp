#include "app/organs/tissue_map_dialog.h"

#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"

#include <QInputDialog>
#include <QLabel>

namespace palp
{

std::optional<StiffnessSource> askTissueMap(QWidget* parent, const StiffnessSource& now)
{
  const QString forms = QObject::tr(
    "<p>Young's modulus over the body, which the corrected law feels:</p><table cellspacing='4'>"
    "<tr><td>labels:FILE:1=healthy_liver,2=40kPa</td><td>regions of a label map</td></tr>"
    "<tr><td>image:FILE</td><td>values of an image, in kPa</td></tr>"
    "<tr><td>array:FILE:NAME</td><td>an array of a surface, in kPa</td></tr>"
    "<tr><td>formula:6+0.1*z</td><td>in kPa, of x, y, z in mm</td></tr>"
    "<tr><td>random:0.3:8mm:7</td><td>relative spread, length, seed</td></tr>"
    "<tr><td>nothing</td><td>the same everywhere</td></tr></table>");
  QInputDialog dialog(parent);
  dialog.setObjectName("tissueMapDialog");
  dialog.setWindowTitle(QObject::tr("Young's modulus map"));
  dialog.setLabelText(forms);
  dialog.setTextValue(QString::fromStdString(describeStiffness(now, now.file.string())));
  dialog.findChild<QLabel*>()->setWordWrap(true);
  while (dialog.exec() == QDialog::Accepted)
  {
    const QString text = dialog.textValue().trimmed();
    try
    {
      const StiffnessSource map =
        text.isEmpty() ? StiffnessSource{} : parseStiffness(text.toStdString(), "map");
      if (map.file.empty()) // files are read when the body is opened
      {
        static_cast<void>(tissueMapOf(map, {}, Eigen::AlignedBox3d(Eigen::Vector3d::Zero())));
      }
      return map;
    }
    catch (const Error& error)
    {
      dialog.setLabelText(
        forms + "<p><b>" + QString::fromStdString(error.what()).toHtmlEscaped() + "</b></p>");
    }
  }
  return std::nullopt;
}

} // namespace palp
