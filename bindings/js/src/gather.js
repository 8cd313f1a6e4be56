// SPDX-License-Identifier: MIT

/** Returns the elements of `array` (`size` numbers each) with the indices `sources`, as an array of the same type. */
export function gather(array, size, sources) {
  const result = new array.constructor(sources.length * size);
  for (let i = 0; i < sources.length; ++i)
    for (let k = 0; k < size; ++k) result[size * i + k] = array[size * sources[i] + k];
  return result;
}
