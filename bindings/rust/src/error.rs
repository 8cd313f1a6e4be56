// SPDX-License-Identifier: MIT
use crate::sys;
use std::ffi::CStr;
use std::fmt;

/// Why a call failed. The numbers are those of the C API, and never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorCode {
    /// An array is empty although it is needed.
    NullData,
    /// Two arrays that must have the same length do not.
    CountMismatch,
    /// An index is not smaller than the number of vertices; [`Error::element`] is its position.
    IndexOutOfRange,
    /// Elements of an interleaved array would overlap.
    StrideTooSmall,
    /// A pointer or stride is not a multiple of 4 bytes.
    Misaligned,
    /// A size does not fit: more than 2,147,483,647 corners.
    TooLarge,
    /// The method needs an attribute (normals, UVs) that the mesh does not have.
    MissingAttribute,
    /// An option has a value outside its range.
    InvalidOption,
    /// There is not enough memory.
    OutOfMemory,
    /// Arrays do not fit the plan that they are evaluated with.
    PlanMismatch,
    /// A defect of tspace.
    Internal,
    /// A number that this crate does not know.
    Other(u32),
}

impl ErrorCode {
    pub(crate) fn of(code: u32) -> ErrorCode {
        match code {
            1 => ErrorCode::NullData,
            2 => ErrorCode::CountMismatch,
            3 => ErrorCode::IndexOutOfRange,
            4 => ErrorCode::StrideTooSmall,
            5 => ErrorCode::Misaligned,
            6 => ErrorCode::TooLarge,
            7 => ErrorCode::MissingAttribute,
            8 => ErrorCode::InvalidOption,
            9 => ErrorCode::OutOfMemory,
            10 => ErrorCode::PlanMismatch,
            11 => ErrorCode::Internal,
            other => ErrorCode::Other(other),
        }
    }
}

/// What went wrong, in words for the person who has to mend it, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind of error.
    pub code: ErrorCode,
    /// Index of the offending element, where there is one.
    pub element: Option<u64>,
    /// One sentence.
    pub message: String,
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

pub(crate) fn mismatch(message: String) -> Error {
    Error { code: ErrorCode::CountMismatch, element: None, message }
}

/// Calls a function of the C API with an error to fill.
pub(crate) fn checked(call: impl FnOnce(*mut sys::Error) -> u32) -> Result<(), Error> {
    let mut error = sys::Error { code: 0, reserved: 0, element: 0, message: [0; 240] };
    let code = call(&mut error);
    if code == sys::OK {
        return Ok(());
    }
    // SAFETY: the library ends the message by 0.
    let message = unsafe { CStr::from_ptr(error.message.as_ptr()) };
    let message = message.to_string_lossy().into_owned();
    let element = if error.element == sys::NO_ELEMENT { None } else { Some(error.element) };
    Err(Error { code: ErrorCode::of(code), element, message })
}
