// SPDX-License-Identifier: MIT
use crate::enums::{Green, Handedness, StoredSign, VAxis, Winding};
use crate::error::{checked, Error};
use crate::sys;
use std::ffi::CString;
use std::mem::{size_of, MaybeUninit};

/// Convention of a format or engine: determines the sign of tangents, and which side of a face is outside. There is no
/// default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Convention {
    /// Position of v = 0.
    pub v_axis: VAxis,
    /// Direction of large green values.
    pub green: Green,
    /// Storage of the sign.
    pub stored_sign: StoredSign,
    /// Handedness of the coordinate system.
    pub handedness: Handedness,
    /// Winding of a face seen from outside.
    pub winding: Winding,
}

impl Convention {
    /// Returns "gltf", "opengl", "directx", "unreal", "unity", "blender" or "godot"; `InvalidOption` for other names.
    pub fn preset(name: &str) -> Result<Convention, Error> {
        let mut raw = sys::Convention { v_axis: 0, green: 0, stored_sign: 0, handedness: 0, winding: 0 };
        let name = CString::new(name).unwrap_or_default();
        // SAFETY: the name ends with 0, and `raw` is written only on success.
        checked(|error| unsafe { sys::tspace_findConvention(name.as_ptr(), &mut raw, error) })?;
        Ok(Convention {
            v_axis: if raw.v_axis == 1 { VAxis::Up } else { VAxis::Down },
            green: if raw.green == 0 { Green::Up } else { Green::Down },
            stored_sign: if raw.stored_sign == 0 { StoredSign::AsIs } else { StoredSign::Negated },
            handedness: if raw.handedness == 0 { Handedness::Right } else { Handedness::Left },
            winding: if raw.winding == 0 { Winding::CounterClockwise } else { Winding::Clockwise },
        })
    }

    pub(crate) fn raw(&self) -> sys::Convention {
        sys::Convention {
            v_axis: self.v_axis as u32,
            green: self.green as u32,
            stored_sign: self.stored_sign as u32,
            handedness: self.handedness as u32,
            winding: self.winding as u32,
        }
    }
}

/// Threads that execute a call. No bit of a result depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Execution {
    /// Only the calling thread.
    #[default]
    OneThread,
    /// A number of threads, which are started and joined within the call.
    Threads(u32),
    /// One thread per core.
    AllThreads,
}

impl Execution {
    pub(crate) fn raw(&self) -> sys::Execution {
        let mut raw = prepared(sys::tspace_initExecution);
        raw.thread_count = match self {
            Execution::OneThread => 1,
            Execution::Threads(count) => *count,
            Execution::AllThreads => u32::MAX,
        };
        raw
    }
}

/// Returns a struct with its size and defaults.
pub(crate) fn prepared<Struct>(init: sys::Init<Struct>) -> Struct {
    let mut raw = MaybeUninit::<Struct>::zeroed();
    // SAFETY: `init` writes a struct of this size, or fails; zero is a valid value of each of these structs.
    unsafe {
        let done = checked(|error| init(raw.as_mut_ptr(), size_of::<Struct>() as u32, error));
        debug_assert_eq!(done, Ok(()));
        raw.assume_init()
    }
}
