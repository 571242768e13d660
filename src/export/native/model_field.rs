//! Values over the faces of a model.
//!
//! ```text
//! offset  type          content
//! 24      u64 x 2       numbers of patches and of faces
//! 40                    for each patch what a PHT-spline has from offset 24 on
//!         u64           for each face its patch
//! ```

use super::bytes::{Reader, Writer};
use super::{FIELD, LoadError, Save, pht};
use crate::model::ModelField;

impl Save for ModelField {
    fn file_kind(&self) -> u32 {
        FIELD
    }

    fn content_size(&self) -> usize {
        16 + self.patches().iter().map(Save::content_size).sum::<usize>() + 8 * self.patch_of_face().len()
    }

    fn write(&self, writer: &mut Writer) {
        writer.count(self.patches().len());
        writer.count(self.patch_of_face().len());
        self.patches().iter().for_each(|patch| patch.write(writer));
        self.patch_of_face().iter().for_each(|&patch| writer.count(patch as usize));
    }
}

pub(super) fn read(reader: &mut Reader) -> Result<ModelField, LoadError> {
    let [patch_count, face_count] = [reader.count()?, reader.count()?];
    let (mut patches, mut patch_of_face) = (Vec::new(), Vec::new());
    for _ in 0..patch_count {
        patches.push(pht::read(reader)?);
    }
    for _ in 0..face_count {
        patch_of_face.push(reader.number()?);
    }
    ModelField::new(patches, patch_of_face)
        .ok_or_else(|| reader.wrong("patches have several dimensions, or a face has no patch"))
}
