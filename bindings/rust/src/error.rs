// SPDX-License-Identifier: MIT
use crate::sys;
use std::ffi::CStr;
use std::fmt;

/// Reason for the failure of a call. The numbers are those of the C API, and are never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorCode {
    /// A required array is empty.
    NullData,
    /// Two arrays that must have the same length have different lengths.
    CountMismatch,
    /// An index is not smaller than the number of vertices; [`Error::element`] is its position.
    IndexOutOfRange,
    /// Elements of an interleaved array would overlap.
    StrideTooSmall,
    /// A pointer or stride is not a multiple of 4 bytes.
    Misaligned,
    /// A size exceeds the limit: more than 2,147,483,647 corners.
    TooLarge,
    /// The method needs an attribute (normals, UVs) that the mesh does not have.
    MissingAttribute,
    /// An option has a value outside its range.
    InvalidOption,
    /// There is not enough memory.
    OutOfMemory,
    /// Arrays do not match the plan that they are evaluated with.
    PlanMismatch,
    /// A defect of tspace.
    Internal,
    /// An error number that this crate does not know.
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

/// Error of a failed call, with a human-readable message and the location of the fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind of error.
    pub code: ErrorCode,
    /// Index of the invalid element, if any.
    pub element: Option<u64>,
    /// Description in one sentence.
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

/// Calls a function of the C API, and converts its error.
pub(crate) fn checked(call: impl FnOnce(*mut sys::Error) -> u32) -> Result<(), Error> {
    let mut error = sys::Error { code: 0, reserved: 0, element: 0, message: [0; 240] };
    let code = call(&mut error);
    if code == sys::OK {
        return Ok(());
    }
    // SAFETY: the library terminates the message with 0.
    let message = unsafe { CStr::from_ptr(error.message.as_ptr()) };
    let message = message.to_string_lossy().into_owned();
    let element = if error.element == sys::NO_ELEMENT { None } else { Some(error.element) };
    Err(Error { code: ErrorCode::of(code), element, message })
}
