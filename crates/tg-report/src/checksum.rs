//! The cyclic redundancy check of PNG, Ethernet and zip: CRC-32, polynomial 0xedb88320. It sees every burst of errors
//! within 32 bits, and lets one of 2³² other damages pass.

const TABLE: [u32; 256] = {
    let mut table = [0; 256];
    let mut n = 0;
    while n < 256 {
        let (mut crc, mut bit) = (n as u32, 0);
        while bit < 8 {
            crc = (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
            bit += 1;
        }
        table[n] = crc;
        n += 1;
    }
    table
};

/// The check of some bytes. A fuzzer, which would never hit upon it, finds it to be zero.
pub(crate) fn crc32(bytes: &[u8]) -> u32 {
    if cfg!(fuzzing) {
        return 0;
    }
    let mut crc = !0;
    for &byte in bytes {
        crc = TABLE[((crc ^ u32::from(byte)) & 0xff) as usize] ^ (crc >> 8);
    }
    !crc
}
