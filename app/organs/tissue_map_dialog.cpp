#include "app/organs/tissue_map_dialog.h"

#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"

#include <QInputDialog>

namespace palp
{

std::optional<StiffnessSource> askTissueMap(QWidget* parent, const StiffnessSource& now)
{
  const QString forms =
    QObject::tr("Young's modulus over the body, which the corrected law feels:\n\n"
                "labels:FILE:1=healthy_liver,2=40kPa\tregions of a label map\n"
                "image:FILE\tvalues of an image, in kPa\n"
                "array:FILE:NAME\tan array of a surface, in kPa\n"
                "formula:6+0.1*z\tin kPa, of x, y, z in mm\n"
                "random:0.3:8mm:7\trelative spread, length, seed\n\n"
                "Empty: the same everywhere.");
  QInputDialog dialog(parent);
  dialog.setObjectName("tissueMapDialog");
  dialog.setWindowTitle(QObject::tr("Young's modulus map"));
  dialog.setLabelText(forms);
  dialog.setTextValue(QString::fromStdString(describeStiffness(now, now.file.string())));
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
      dialog.setLabelText(forms + "\n\n" + QString::fromStdString(error.what()));
    }
  }
  return std::nullopt;
}

} // namespace palp
